// safety.ack-implies-received: a descriptor that the writer takes as acknowledged (A) has been
// received (X = 1); it is looked at when it enters A. safety.ack-stable: it leaves A only if its
// reader has not got it any more. What was acknowledged before the run is not judged: a reader may
// have forgotten it there.
#include <bit>

#include "model/implementations.hpp"
#include "props/monitors/data_observer.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/monitors.hpp"

namespace stormproof::props {

namespace {

/// Sees descriptors change their states, and knows who has them.
class Acknowledgments : public DataObserver<> {
 public:
  static constexpr std::array hears_machines{model::Report::descriptor_transition};

  Acknowledgments(std::string_view property, const model::Scenario& scenario)
      : DataObserver{property} {
    if (scenario.deployment.life) let_readers_forget();
  }

  void transition(const model::Transition& fired) override {
    DataObserver::transition(fired);
    if (fired.descriptors == 0) return;
    // A writer that has forgotten believes nothing.
    if (fired.event == ReceivedDescriptors::renewed || events() == 0 || fired.before == fired.after)
      return;
    moved({fired.machine.subject, fired.first_word, fired.descriptors}, fired.before, fired.after,
          x().word(fired.machine.subject, fired.first_word));
  }

 protected:
  struct Moved {
    std::uint32_t relation = 0;
    std::uint32_t first_word = 0;
    std::uint64_t descriptors = 0;
  };
  /// Descriptors of one word went from state to state; `has` are those that the reader has.
  virtual void moved(const Moved&, std::string_view before, std::string_view after,
                     std::uint64_t has) = 0;
  /// The first of those of the word.
  [[nodiscard]] std::string first_of(const Moved& in, std::uint64_t some) const {
    const auto d = 64 * in.first_word + static_cast<std::uint32_t>(std::countr_zero(some));
    return descriptor_text(topology(), in.relation, d);
  }
};

class TruthOfAcknowledgments : public Acknowledgments {
 public:
  explicit TruthOfAcknowledgments(const model::Scenario& scenario)
      : Acknowledgments{"safety.ack-implies-received", scenario} {}

  [[nodiscard]] std::vector<std::string> remarks() const override {
    return {std::to_string(acknowledged_) + " descriptors became acknowledged."};
  }

 protected:
  void moved(const Moved& what, std::string_view, std::string_view after,
             std::uint64_t has) override {
    if (after != "A") return;
    acknowledged_ += static_cast<std::uint64_t>(std::popcount(what.descriptors));
    const std::uint64_t wrong = what.descriptors & ~has;
    if (wrong == 0) return;
    object_now("The writer takes " + first_of(what, wrong) + " as acknowledged at " +
               time_text(now()) + ", but it has not been received there.");
  }

 private:
  std::uint64_t acknowledged_ = 0;
};

class StabilityOfAcknowledgments : public Acknowledgments {
 public:
  explicit StabilityOfAcknowledgments(const model::Scenario& scenario)
      : Acknowledgments{"safety.ack-stable", scenario} {}

  [[nodiscard]] std::vector<std::string> remarks() const override {
    return {std::to_string(taken_back_) + " acknowledgments were taken back of what was missing."};
  }

 protected:
  void moved(const Moved& what, std::string_view before, std::string_view,
             std::uint64_t has) override {
    if (before != "A") return;
    taken_back_ += static_cast<std::uint64_t>(std::popcount(what.descriptors & ~has));
    const std::uint64_t wrong = what.descriptors & has;
    if (wrong == 0) return;
    object_now("The writer takes back the acknowledgment of " + first_of(what, wrong) + " at " +
               time_text(now()) + ", which has it and has not forgotten it.");
  }

 private:
  std::uint64_t taken_back_ = 0;
};

}  // namespace

MonitorPtr watch_acknowledgments(const model::Scenario& scenario) {
  if (has_samples(scenario)) return watch_acknowledged_samples();
  return attentive<TruthOfAcknowledgments>(scenario);
}
MonitorPtr watch_stable_acknowledgments(const model::Scenario& scenario) {
  return attentive<StabilityOfAcknowledgments>(scenario);
}

}  // namespace stormproof::props
