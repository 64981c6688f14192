// safety.ack-implies-received under Cyclone DDS's writer, which takes acknowledgments as a number
// of samples: what a reader that has replied acknowledges, it has received. A new reader counts as
// having what exists when it is matched, until it says otherwise in its first reply.
#include <algorithm>
#include <vector>

#include <fmt/core.h>

#include "model/implementations.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/submessage_observer.hpp"

namespace stormproof::props {

namespace {

class CycloneAcknowledgments : public SubmessageObserver<> {
 public:
  CycloneAcknowledgments() : SubmessageObserver{"safety.ack-implies-received"} {}

  void run_started(const model::Topology& topology) override {
    SubmessageObserver::run_started(topology);
    acknowledged_.assign(numbers().relation_count(), 0);
  }

  [[nodiscard]] std::vector<std::string> remarks() const override {
    return {fmt::format("{} acknowledgments were looked at.", judged_)};
  }

 private:
  void matched(std::uint32_t relation) override {
    acknowledged_[relation] = gathered().samples_of(numbers().writer_of(relation));
  }
  void heard(std::uint32_t relation, const model::Submessage& taken,
             const States& states) override {
    if (taken.kind != model::Submessage::Kind::acknack) return;
    acknowledged_[relation] = std::max(acknowledged_[relation], taken.sample);
    if (states.after == "Replied") judge(relation);
  }
  void judge(std::uint32_t relation) {
    if (!numbers().is_of_stream(relation)) return;
    ++judged_;
    const std::uint32_t sample = gathered().taken(relation).first_gap();
    if (sample >= acknowledged_[relation]) return;
    const model::Pair& ends = numbers().ends(relation);
    object_now(fmt::format(
        "The writer of {} of participant {} takes sample {} as acknowledged by participant {} at "
        "{}, but it has not been received there.",
        model::cyclone::name_of_writer(relation % numbers().stride()), ends.source, sample + 1,
        ends.destination, time_text(now())));
  }

  std::vector<std::uint32_t> acknowledged_;  // by relation: the first samples, as the writer has it
  std::uint64_t judged_ = 0;
};

}  // namespace

bool has_samples(const model::Scenario& scenario) {
  return model::traits_of(scenario.dds).writer == model::Writer::of_cyclone;
}
MonitorPtr watch_acknowledged_samples() { return attentive<CycloneAcknowledgments>(); }

}  // namespace stormproof::props
