// safety.ack-implies-received under Cyclone DDS's writer, which takes acknowledgments as a number
// of samples: what a reader that has replied acknowledges, it has received. A new reader counts as
// having what exists when it is matched, until it says otherwise in its first reply.
#include <algorithm>
#include <vector>

#include <fmt/core.h>

#include "model/implementations.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/descriptors.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/submessage_observer.hpp"

namespace stormproof::props {

namespace {

class CycloneAcknowledgments : public SubmessageObserver<> {
 public:
  static constexpr auto selection_of_kinds = of_creations;

  CycloneAcknowledgments() : SubmessageObserver{"safety.ack-implies-received"} {}

  void run_started(const model::Topology& topology) override {
    SubmessageObserver::run_started(topology);
    history_.assign(numbers().writer_count(), 0);
    relations_.assign(numbers().relation_count(), {});
  }
  /// What a participant creates is one sample more of one of its writers.
  void event_started(const model::Event& event) override {
    SubmessageObserver::event_started(event);
    if (event.kind != model::EventKind::endpoint_creation) return;
    ++history_[numbers().writer_of_creation(event)];
  }

  [[nodiscard]] std::vector<std::string> remarks() const override {
    return {fmt::format("{} acknowledgments were looked at.", judged_)};
  }

 private:
  struct Relation {
    std::uint32_t acknowledged = 0;  ///< the first samples, as the writer has it
    Descriptors received;            ///< samples that the reader has taken
  };

  void matched(std::uint32_t relation) override {
    relations_[relation].acknowledged = history_[numbers().writer_of(relation)];
  }
  void heard(std::uint32_t relation, const model::Submessage& taken,
             const States& states) override {
    Relation& of = relations_[relation];
    if (taken.kind == model::Submessage::Kind::data) of.received.add(taken.sample);
    if (taken.kind != model::Submessage::Kind::acknack) return;
    of.acknowledged = std::max(of.acknowledged, taken.sample);
    if (states.after == "Replied") judge(relation, of);
  }
  void judge(std::uint32_t relation, const Relation& of) {
    if (!numbers().is_of_stream(relation)) return;
    ++judged_;
    const std::uint32_t sample = of.received.first_gap();
    if (sample >= of.acknowledged) return;
    const model::Pair& ends = numbers().ends(relation);
    object_now(fmt::format(
        "The writer of {} of participant {} takes sample {} as acknowledged by participant {} at "
        "{}, but it has not been received there.",
        model::cyclone::name_of_writer(relation % numbers().stride()), ends.source, sample + 1,
        ends.destination, time_text(now())));
  }

  std::vector<std::uint32_t> history_;  // by writer: how many samples exist
  std::vector<Relation> relations_;
  std::uint64_t judged_ = 0;
};

}  // namespace

bool has_samples(const model::Scenario& scenario) {
  return model::traits_of(scenario.dds).writer == model::Writer::of_cyclone;
}
MonitorPtr watch_acknowledged_samples() { return attentive<CycloneAcknowledgments>(); }

}  // namespace stormproof::props
