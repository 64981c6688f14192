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
#include <array>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "props/monitors/describe.hpp"
#include "props/monitors/descriptors.hpp"
#include "props/monitors/event_ends.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/packet_fates.hpp"
#include "props/monitors/submessage_observer.hpp"

namespace stormproof::props {

namespace {

using model::EventKind;
using Kind = model::MachineRef::Kind;

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
          .only({model::Report::event_started},
                {EventKind::endpoint_creation, EventKind::participant_start, EventKind::spdp_time,
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
    participants_.assign(topology.participant_count(), {});
    writers_.assign(received_.writer_count(), {});
    relations_.assign(received_.relation_count(), {});
  }
  void event_started(const model::Event& event) override {
    SubmessageObserver::event_started(event);
    switch (event.kind) {
      case EventKind::endpoint_creation:
        ++writers_[received_.writer_of_creation(event)].samples;
        unrest(now());
        return touch(event.subject);
      case EventKind::participant_start:
        return touch(event.subject);
      case EventKind::spdp_time:
        take(participants_[event.subject].announcements);
        return touch(event.subject);
      case EventKind::thread_run:
        take(participants_[event.subject].runs);
        return touch(event.subject);
      case EventKind::heartbeat_time:
        take(writers_[event.subject].heartbeats);
        return touch(event.subject / received_.stride());
      default:
        return;
    }
  }
  void scheduled(std::uint64_t, model::Nanoseconds, EventKind kind,
                 std::uint32_t subject) override {
    if (kind == EventKind::spdp_time) ++participants_[subject].announcements.pending;
    if (kind == EventKind::thread_run) ++participants_[subject].runs.pending;
    if (kind == EventKind::heartbeat_time) ++writers_[subject].heartbeats.pending;
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
    const std::uint32_t n = fired.machine.subject;
    if (fired.machine.kind == Kind::endpoint_writer) {
      if (fired.machine.machine == "MovableTimer") writers_[n].heartbeats.now_in(fired.after);
    } else if (fired.machine.kind == Kind::participant) {
      if (fired.machine.machine == "EventThread") participants_[n].runs.now_in(fired.after);
      if (fired.machine.machine == "MovableTimer")
        participants_[n].announcements.now_in(fired.after);
    }
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
  /// What makes it go on: its events that are pending, and the state of its machine.
  struct Timer {
    std::uint64_t pending = 0;
    bool is_scheduled = false;
    bool is_listed = false;  ///< of a thread
    bool is_awake = false;   ///< the thread itself

    void now_in(std::string_view state) {
      is_scheduled = state == "Scheduled";
      is_listed = state == "Listed";
      is_awake = state != "Asleep";
    }
  };
  struct Participant {
    Timer announcements;
    Timer runs;  ///< of its thread
    bool is_touched = false;
  };
  struct Writer {
    std::uint32_t samples = 0;  ///< that exist
    Timer heartbeats;
  };
  struct Relation {
    Descriptors have;              ///< samples that the reader has taken
    std::uint32_t have_count = 0;  ///< of them
    bool writer_side = false;
    bool reader_side = false;
  };

  static void take(Timer& timer) {
    if (timer.pending > 0) --timer.pending;
  }
  void touch(std::uint32_t i) {
    await_end();
    if (!std::exchange(participants_[i].is_touched, true)) touched_.push_back(i);
  }
  void matched(std::uint32_t relation) override {
    relations_[relation].writer_side = true;
    side_opened(relation);
  }
  void opened(std::uint32_t relation) override {
    relations_[relation].reader_side = true;
    side_opened(relation);
  }
  void side_opened(std::uint32_t relation) {
    unrest(now());
    touch(received_.ends(relation).source);
  }
  void heard(std::uint32_t relation, const model::Submessage& taken, const States&) override {
    Relation& reader = relations_[relation];
    if (taken.kind != model::Submessage::Kind::data || reader.have.has(taken.sample)) return;
    reader.have.add(taken.sample);
    ++reader.have_count;
  }
  void judge_event(const model::Depths&) override {
    std::ranges::sort(touched_);
    for (const std::uint32_t i : touched_) {
      judge(i, now());
      participants_[i].is_touched = false;
    }
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
      const Writer& writer = writers_[received_.writer_of(relation)];
      const Relation& reader = relations_[relation];
      if (reader.have_count >= writer.samples) continue;
      ++judged_;
      if (!reader.writer_side) {
        if (!goes_on(participants_[ends.destination].announcements, ends.destination)) {
          object_to(relation, time,
                    "its writer does not know the reader, which announces itself no more");
        }
      } else if (!reader.reader_side) {
        if (!goes_on(participants_[ends.source].announcements, ends.source)) {
          object_to(relation, time,
                    "its reader does not know the writer, which announces itself no more");
        }
      } else if (!goes_on(writer.heartbeats, ends.source)) {
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
  /// A timer of participant i.
  [[nodiscard]] bool goes_on(const Timer& timer, std::uint32_t i) const {
    if (timer.is_scheduled) return timer.pending > 0;
    const Timer& thread = participants_[i].runs;
    return timer.is_listed && thread.is_awake && thread.pending > 0;
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
  std::vector<Participant> participants_;
  std::vector<Writer> writers_;
  std::vector<Relation> relations_;
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
