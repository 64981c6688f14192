// safety.ack-implies-received under Cyclone DDS's writer, which takes acknowledgments as a number
// of samples: what a reader that has replied acknowledges, it has received. A new reader counts as
// having what exists when it is matched, until it says otherwise in its first reply.
#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include <fmt/core.h>

#include "model/cyclone/endpoints.hpp"
#include "model/engine/submessage.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/observer.hpp"

namespace stormproof::props {

namespace {

namespace cyclone = model::cyclone;
using Kind = model::Submessage::Kind;

class CycloneAcknowledgments : public Observer {
 public:
  CycloneAcknowledgments() : Observer{"safety.ack-implies-received"} {}

  void run_started(const model::Topology& topology) override {
    Observer::run_started(topology);
    stride_ = cyclone::writers_per_participant(topology);
  }
  /// What a participant creates is one sample more of one of its writers.
  void event_started(const model::Event& event) override {
    Observer::event_started(event);
    if (event.kind != model::EventKind::endpoint_creation) return;
    const std::uint32_t publications =
        topology().descriptor_count(event.subject, model::Stream::pub) -
        model::default_publications;
    const bool is_publication =
        model::creation_order(event.detail, publications).stream == model::Stream::pub;
    ++history_[stride_ * event.subject +
               (is_publication ? cyclone::writer::publications : cyclone::writer::subscriptions)];
  }
  void received(const model::Packet& packet, std::uint32_t) override {
    submessages_ = packet.submessages;
    next_ = 0;
  }
  void transition(const model::MachineRef& machine, std::string_view event, std::string_view,
                  std::string_view after, std::uint32_t, std::uint64_t) override {
    const std::uint32_t relation = machine.subject;
    if (machine.machine == "CautiousReader") {
      if (event == "HeartbeatReceived") (void)next(Kind::heartbeat, relation);
      if (event != "DataReceived") return;
      if (const model::Submessage* data = next(Kind::data, relation)) {
        relations_[relation].received.insert(data->sample);
      }
    } else if (machine.machine == "MatchedReader") {
      Relation& of = relations_[relation];
      if (event == "Opened") of.acknowledged = history_[writer_of(relation)];
      const bool is_answer = event == "AckNackReceived";
      const model::Submessage* acknack = is_answer ? next(Kind::acknack, relation) : nullptr;
      if (acknack == nullptr) return;
      of.acknowledged = std::max(of.acknowledged, acknack->sample);
      if (after == "Replied") judge(relation, of);
    }
  }

  [[nodiscard]] std::vector<std::string> remarks() const override {
    return {fmt::format("{} acknowledgments were looked at.", judged_)};
  }

 private:
  struct Relation {
    std::uint32_t acknowledged = 0;    ///< the first samples, as the writer has it
    std::set<std::uint32_t> received;  ///< what the reader has taken
  };

  [[nodiscard]] std::uint32_t writer_of(std::uint32_t relation) const {
    return stride_ * topology().pair(relation / stride_).source + relation % stride_;
  }
  /// The next submessage of the packet that is about the writer of the relation, in their order.
  /// Those before it have been ignored.
  const model::Submessage* next(Kind kind, std::uint32_t relation) {
    while (submessages_ != nullptr && next_ < submessages_->size()) {
      const model::Submessage& m = (*submessages_)[next_++];
      if (m.kind == kind && m.writer == relation % stride_) return &m;
    }
    return nullptr;
  }
  void judge(std::uint32_t relation, const Relation& of) {
    if (relation % stride_ > cyclone::writer::subscriptions) return;
    ++judged_;
    for (std::uint32_t sample = 0; sample < of.acknowledged; ++sample) {
      if (of.received.contains(sample)) continue;
      const model::Pair& ends = topology().pair(relation / stride_);
      return object_now(fmt::format(
          "The writer of {} of participant {} takes sample {} as acknowledged by participant {} at "
          "{}, but it has not been received there.",
          cyclone::name_of_writer(relation % stride_), ends.source, sample + 1, ends.destination,
          time_text(now())));
    }
  }

  std::uint32_t stride_ = 1;
  std::map<std::uint32_t, std::uint32_t> history_;  // by writer: how many samples exist
  std::map<std::uint32_t, Relation> relations_;
  std::shared_ptr<const std::vector<model::Submessage>> submessages_;  // of what is received
  std::size_t next_ = 0;
  std::uint64_t judged_ = 0;
};

}  // namespace

MonitorPtr watch_acknowledged_samples() { return attentive<CycloneAcknowledgments>(); }

}  // namespace stormproof::props
