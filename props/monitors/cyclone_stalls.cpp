// live.no-stall under Cyclone DDS: while a started receiver lacks a sample that exists, what brings
// the next step is under way. As long as one of the two does not know the other, that is the
// announcement timer of the unknown one; from then on the writer's HEARTBEAT timer, since it goes
// on while a reader has not replied or not acknowledged everything. A timer is under way if it is
// scheduled and its event is pending, or if it is on the list of a thread that runs. Only
// cross-host relations of the two streams are looked at, each after the events that concern it.
//
// HEARTBEATs that go on may bring nothing. Where the scenario says of each packet how long it
// takes, and threads have time for what their timers ask of them, whatever is missing has to come
// once all lost and late packets are over and every timer has been due several times.
#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "props/monitors/describe.hpp"
#include "props/monitors/event_ends.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/packet_fates.hpp"
#include "props/monitors/submessage_observer.hpp"
#include "props/monitors/thread_timers.hpp"

namespace stormproof::props {

namespace {

using model::EventKind;

/// Whether a thread has sent all that one timer can make it send, to everybody, before the next one
/// is due.
bool threads_keep_up(const model::Scenario& scenario) {
  if (scenario.hosts) return false;
  const model::SpdpProfile& spdp = scenario.dds.spdp;
  const model::Nanoseconds least =
      std::min({spdp.period, spdp.startup_period, spdp.directed_reply_interval,
                scenario.dds.sedp.heartbeat_interval});
  const model::Topology topology = model::topology_of(scenario);
  std::int64_t most = 0;  // samples of one writer
  for (std::uint32_t r = 0; r < topology.relation_count(); ++r) {
    most = std::max<std::int64_t>(most, topology.descriptor_count(r));
  }
  constexpr std::int64_t others = 4;  // announcement, liveliness, HEARTBEAT, ACKNACK
  return least >=
         scenario.deployment.time_to_send() * ((most + others) * topology.participant_count());
}

class CycloneStalls : public SubmessageObserver<EndObserver> {
 public:
  static constexpr auto selection_of_kinds =
      model::trace::Selection{}
          .only({model::Report::event_started}, {EventKind::participant_start, EventKind::spdp_time,
                                                 EventKind::thread_run, EventKind::heartbeat_time})
          .only({model::Report::scheduled},
                {EventKind::spdp_time, EventKind::thread_run, EventKind::heartbeat_time});

  explicit CycloneStalls(const model::Scenario& scenario)
      : SubmessageObserver{"live.no-stall"}, wireless_{scenario.wireless} {
    if (wireless_.kind == model::ServiceKind::constant_delay && threads_keep_up(scenario)) {
      patience_ = patience_with_cyclone(scenario);
    }
  }

  void run_started(const model::Topology& topology) override {
    SubmessageObserver::run_started(topology);
    topology_.emplace(topology);
    received_.reset(*topology_);
    timers_.reset(topology.participant_count(), received_.writer_count());
    has_writer_side_.assign(received_.relation_count(), false);
    has_reader_side_.assign(received_.relation_count(), false);
  }
  void event_started(const model::Event& event) override {
    SubmessageObserver::event_started(event);
    timers_.started(event);
    const bool is_own = event.kind == EventKind::participant_start ||
                        event.kind == EventKind::spdp_time || event.kind == EventKind::thread_run;
    if (is_own) touch(event.subject);
    if (event.kind == EventKind::heartbeat_time) touch(event.subject / received_.stride());
  }
  void scheduled(std::uint64_t, model::Nanoseconds, EventKind kind,
                 std::uint32_t subject) override {
    timers_.scheduled(kind, subject);
  }
  /// A lost packet would have arrived as late as one that is not lost.
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override {
    SubmessageObserver::emitted(packet, source, destinations);
    if (!patience_) return;
    for (std::uint64_t n = packet.number; n < packet.number + packet.copies; ++n) {
      const model::Nanoseconds one_way = one_way_of(wireless_, n);
      if (is_lost(wireless_, n) || one_way > wireless_.one_way) unrest(now() + one_way);
    }
  }
  void transition(const model::Transition& fired) override {
    SubmessageObserver::transition(fired);
    timers_.transition(fired);
  }
  void finish(model::Nanoseconds end) override {
    if (!topology_) return;
    is_long_quiet_ = patience_ && end >= last_unrest_ + *patience_;
    for (std::uint32_t i = 0; i < topology_->participant_count(); ++i) judge(i, end);
  }

  [[nodiscard]] std::vector<std::string> remarks() const override {
    return {fmt::format("{} times a reader that lacks something was looked at.", judged_)};
  }

 private:
  void touch(std::uint32_t i) {
    await_end();
    if (std::ranges::find(touched_, i) == touched_.end()) touched_.push_back(i);
  }
  void created(std::uint32_t writer, std::uint32_t) override {
    unrest(now());
    touch(writer / received_.stride());
  }
  void matched(std::uint32_t relation) override {
    has_writer_side_[relation] = true;
    note_side(relation);
  }
  void opened(std::uint32_t relation) override {
    has_reader_side_[relation] = true;
    note_side(relation);
  }
  void note_side(std::uint32_t relation) {
    unrest(now());
    touch(received_.ends(relation).source);
  }
  void judge_event(const model::Depths&) override {
    std::ranges::sort(touched_);
    for (const std::uint32_t i : touched_) judge(i, now());
    touched_.clear();
  }
  /// All that lack something of participant i, or that i does not know.
  void judge(std::uint32_t i, model::Nanoseconds time) {
    for (std::uint32_t pair = topology_->first_pair(i); pair < topology_->first_pair(i + 1);
         ++pair) {
      const model::Pair& ends = topology_->pair(pair);
      if (!ends.cross_host || violation()) continue;
      if (time <= topology_->start(i) || time <= topology_->start(ends.destination)) continue;
      judge_pair(pair, time);
      judge_pair(ends.reverse, time);
    }
  }
  void judge_pair(std::uint32_t pair, model::Nanoseconds time) {
    const model::Pair& ends = topology_->pair(pair);
    for (std::uint32_t s = 0; s < std::size(model::streams); ++s) {
      const std::uint32_t relation = received_.stride() * pair + s;
      const std::uint32_t writer = received_.writer_of(relation);
      if (gathered().taken(relation).first_gap() >= gathered().samples_of(writer)) continue;
      ++judged_;
      if (!has_writer_side_[relation]) {
        if (!timers_.announces(ends.destination)) {
          object_to(relation, time,
                    "its writer does not know the reader, which announces itself no more");
        }
      } else if (!has_reader_side_[relation]) {
        if (!timers_.announces(ends.source)) {
          object_to(relation, time,
                    "its reader does not know the writer, which announces itself no more");
        }
      } else if (!timers_.heartbeats(writer, ends.source)) {
        object_to(relation, time, "the HEARTBEAT timer of its writer is not under way");
      } else if (is_long_quiet_) {
        object_to(
            relation, time,
            fmt::format("no packet has been lost or late since {}, and every timer has been due "
                        "several times",
                        time_text(last_unrest_)));
      }
    }
  }
  void object_to(std::uint32_t relation, model::Nanoseconds time, std::string_view why) {
    const model::Pair& ends = received_.ends(relation);
    object(event(), time,
           fmt::format("From {} on nothing can bring participant {} what it lacks of the {} of "
                       "participant {}: {}.",
                       time_text(time), ends.destination,
                       model::cyclone::name_of_writer(relation % received_.stride()), ends.source,
                       why));
  }

  void unrest(model::Nanoseconds time) { last_unrest_ = std::max(last_unrest_, time); }

  const model::WirelessProfile wireless_;
  std::optional<model::Nanoseconds> patience_;
  model::Nanoseconds last_unrest_;  ///< until then packets are lost or late, or something is new
  bool is_long_quiet_ = false;
  std::optional<model::Topology> topology_;
  ReceivedSubmessages received_;  // the numbers, after the run, too
  ThreadTimers timers_;
  std::vector<bool> has_writer_side_;  // by relation
  std::vector<bool> has_reader_side_;
  std::vector<std::uint32_t> touched_;  // participants
  std::uint64_t judged_ = 0;
};

}  // namespace

MonitorPtr watch_stalls_of_cyclone(const model::Scenario& scenario) {
  return attentive<CycloneStalls>(scenario);
}

model::Nanoseconds patience_with_cyclone(const model::Scenario& scenario) {
  const model::SedpProfile& sedp = scenario.dds.sedp;
  constexpr int exchanges = 3;
  return (sedp.heartbeat_interval_max + sedp.auto_resched_nack_delay + sedp.nack_delay +
          scenario.wireless.one_way * 3) *
         exchanges;
}

}  // namespace stormproof::props
