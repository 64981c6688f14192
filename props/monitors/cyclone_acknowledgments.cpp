// safety.ack-implies-received under Cyclone DDS's writer, which takes acknowledgments as a number
// of samples: what a reader that has replied acknowledges, it has received. A new reader counts as
// having what exists when it is matched, until it says otherwise in its first reply.
#include <algorithm>
#include <map>
#include <set>

#include <fmt/core.h>

#include "model/implementations.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/observer.hpp"
#include "props/monitors/received_submessages.hpp"

namespace stormproof::props {

namespace {

class CycloneAcknowledgments : public Observer {
 public:
  CycloneAcknowledgments() : Observer{"safety.ack-implies-received"} {}

  void run_started(const model::Topology& topology) override {
    Observer::run_started(topology);
    received_.reset(topology);
  }
  /// What a participant creates is one sample more of one of its writers.
  void event_started(const model::Event& event) override {
    Observer::event_started(event);
    if (event.kind != model::EventKind::endpoint_creation) return;
    ++history_[received_.writer_of_creation(event)];
  }
  void received(const model::Packet& packet, std::uint32_t) override { received_.arriving(packet); }
  void transition(const model::MachineRef& machine, std::string_view event, std::string_view,
                  std::string_view after, std::uint32_t, std::uint64_t) override {
    const std::uint32_t relation = machine.subject;
    const model::Submessage* heard = received_.heard(machine, event);
    if (machine.machine == "MatchedReader" && event == "Opened") {
      relations_[relation].acknowledged = history_[received_.writer_of(relation)];
    }
    if (heard == nullptr) return;
    Relation& of = relations_[relation];
    if (heard->kind == model::Submessage::Kind::data) of.received.insert(heard->sample);
    if (heard->kind != model::Submessage::Kind::acknack) return;
    of.acknowledged = std::max(of.acknowledged, heard->sample);
    if (after == "Replied") judge(relation, of);
  }

  [[nodiscard]] std::vector<std::string> remarks() const override {
    return {fmt::format("{} acknowledgments were looked at.", judged_)};
  }

 private:
  struct Relation {
    std::uint32_t acknowledged = 0;    ///< the first samples, as the writer has it
    std::set<std::uint32_t> received;  ///< what the reader has taken
  };

  void judge(std::uint32_t relation, const Relation& of) {
    if (!received_.is_of_stream(relation)) return;
    ++judged_;
    for (std::uint32_t sample = 0; sample < of.acknowledged; ++sample) {
      if (of.received.contains(sample)) continue;
      const model::Pair& ends = received_.ends(relation);
      return object_now(fmt::format(
          "The writer of {} of participant {} takes sample {} as acknowledged by participant {} at "
          "{}, but it has not been received there.",
          model::cyclone::name_of_writer(relation % received_.stride()), ends.source, sample + 1,
          ends.destination, time_text(now())));
    }
  }

  ReceivedSubmessages received_;
  std::map<std::uint32_t, std::uint32_t> history_;  // by writer: how many samples exist
  std::map<std::uint32_t, Relation> relations_;
  std::uint64_t judged_ = 0;
};

}  // namespace

bool has_samples(const model::Scenario& scenario) {
  return model::traits_of(scenario.dds).writer == model::Writer::of_cyclone;
}
MonitorPtr watch_acknowledged_samples() { return attentive<CycloneAcknowledgments>(); }

}  // namespace stormproof::props
