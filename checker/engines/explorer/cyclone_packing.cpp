// What Cyclone DDS's rules read and schedule in a way of their own: times, timers and events.
#include "checker/engines/explorer/cyclone_packing.hpp"

#include <algorithm>
#include <bit>

#include <fmt/core.h>

#include "fsm/heartbeat_pacer.hpp"

namespace stormproof::explorer {
namespace {

namespace owner = fsm::composition::owner;

/// Beyond the end of time; a number of a mark beyond that is the time of the mark.
constexpr std::int64_t later = std::int64_t{1} << 60;

/// What the host keeps or answers: times first, each a mark of the frame.
enum class Own : std::uint8_t {
  last_heartbeat,
  heartbeat_counts_until,
  acknack_counts_until,
  quiet_until,
  hush_until,
  again_at,
  heartbeats_since,
  ack_due,
  heartbeat_due,
  is_queued,
  queue_is_full,
  answer_is_kept,
  some_answer_is_kept
};
struct OwnThing {
  std::string_view name;
  Own own{};
};
constexpr std::array own_things{OwnThing{"LastHeartbeat", Own::last_heartbeat},
                                OwnThing{"HeartbeatCountsUntil", Own::heartbeat_counts_until},
                                OwnThing{"AckCountsUntil", Own::acknack_counts_until},
                                OwnThing{"QuietUntil", Own::quiet_until},
                                OwnThing{"HushUntil", Own::hush_until},
                                OwnThing{"AgainAt", Own::again_at},
                                OwnThing{"HeartbeatsSince", Own::heartbeats_since},
                                OwnThing{"AckDue", Own::ack_due},
                                OwnThing{"HeartbeatDue", Own::heartbeat_due},
                                OwnThing{"IsQueued", Own::is_queued},
                                OwnThing{"IsQueuedForIt", Own::is_queued},
                                OwnThing{"QueueIsFull", Own::queue_is_full},
                                OwnThing{"AnswerIsKept", Own::answer_is_kept},
                                OwnThing{"SomeAnswerIsKept", Own::some_answer_is_kept}};
constexpr bool is_time(Own own) { return own <= Own::again_at; }
constexpr What mark_of(Own time) {
  return What{static_cast<std::uint8_t>(static_cast<unsigned>(What::last_heartbeat) +
                                        static_cast<unsigned>(time))};
}

std::int64_t interval_of(const model::SedpProfile& sedp, std::int64_t number) {
  fsm::HeartbeatPacerIo::Input<fsm::Plain> in;
  in.interval = sedp.heartbeat_interval.count();
  in.interval_max = sedp.heartbeat_interval_max.count();
  return fsm::heartbeat_pacer::interval_after<fsm::Plain>(in, number);
}
/// After so many HEARTBEATs intervals do not grow any more.
std::int64_t most_heartbeats(const model::SedpProfile& sedp) {
  constexpr std::int64_t enough = 200;
  std::int64_t number = 0;
  while (interval_of(sedp, number) < interval_of(sedp, enough)) ++number;
  return number;
}

}  // namespace

CyclonePacking::CyclonePacking(const fsm::program::Program& program, const model::Scenario& running,
                               const Scope& scope, const EventRules& rules)
    : Packing{running, scope},
      program_{program},
      rules_{rules},
      most_heartbeats_{most_heartbeats(sedp())} {}

void CyclonePacking::keep(Layout& layout) {
  static_assert(sizeof(Queue) == (most_queued + 1) * sizeof(std::uint64_t));
  queue_ = layout.keep(sizeof(Queue), owner::relation);
  kept_ = layout.keep(sizeof(Slot), owner::relation);
  keeps_ = layout.keep(1, owner::relation);
  listed_ = layout.keep(1, owner::participant);
  heartbeats_since_ = layout.keep(sizeof(std::int64_t), owner::relation);
  ack_missed_ = layout.keep(1, owner::relation);
  heartbeat_missed_ = layout.keep(1, owner::relation);
  const auto of = [&](std::string_view name) { return layout.of(program_.find(name)); };
  sent_ = of("Sent");
  exists_ = of("Exists");
  received_ = of("X");
  judge_ = of("Judge");
  peer_ = of("Peer");
  acked_ = of("Acked");
  counts_ = {
      {{of("HeartbeatCount"), of("LastHeartbeatCount")}, {of("NextAckCount"), of("LastAckCount")}}};
}

std::optional<unsigned> CyclonePacking::keeps(std::string_view thing) const {
  const auto* const found = std::ranges::find(own_things, thing, &OwnThing::name);
  if (found == own_things.end()) return std::nullopt;
  return static_cast<unsigned>(found->own);
}

bool CyclonePacking::is_decided_by_reading(unsigned own) const {
  return is_time(Own{static_cast<std::uint8_t>(own)});
}
std::int64_t CyclonePacking::interval(const WorldState& state) const {
  return interval_of(sedp(), state.get<std::int64_t>(heartbeats_since_));
}

Specialised::Action CyclonePacking::action(std::string_view step) {
  using Call = Specialised::Call;
  const auto to_all = [this](RuleRunner& w, const Call& call) {
    for (Slot message : w.emitted_by(call.contract)) {
      message.flags |= Slot::to_set;
      if (!leaves(message, w)) w.frame().overflow();
    }
  };
  const auto join = [this](unsigned participant) {
    return
        [this, participant](RuleRunner& w, const Call&) { ++*w.state().at(listed_, participant); };
  };
  if (step == "HeartbeatToAll" || step == "DataToAll") return to_all;
  if (step == "LetAnswerGo") return [this](RuleRunner& w, const Call&) { let_answer_go(w); };
  if (step == "JoinList HeartbeatTimer") return join(0);
  if (step == "JoinList AckTimer") return join(1);
  if (step == "Work") return [this](RuleRunner& w, const Call&) { work(w); };
  return {};
}

// Times and answers. All that is queued goes to the one reader.

std::int64_t CyclonePacking::read(unsigned number, RuleRunner& w) {
  const Own own{static_cast<std::uint8_t>(number)};
  switch (own) {
    case Own::last_heartbeat:
      return last_heartbeat(w);
    case Own::heartbeats_since:
      return w.state().get<std::int64_t>(heartbeats_since_);
    case Own::ack_due:
      return due(What::ack_time, *w.state().at(ack_missed_) != 0);
    case Own::heartbeat_due:
      return due(What::heartbeat_time, *w.state().at(heartbeat_missed_) != 0);
    case Own::is_queued: {
      Queue waiting = queue(w.state());
      return std::ranges::any_of(waiting.waiting(), [&](const Slot& m) {
        return m.what == What::data && m.has(Slot::from_repair) && m.set == member(w.descriptor());
      });
    }
    case Own::queue_is_full: {
      Queue waiting = queue(w.state());
      const auto repairs = std::ranges::count_if(
          waiting.waiting(), [](const Slot& m) { return m.has(Slot::from_repair); });
      return static_cast<std::uint32_t>(repairs) >= sedp().max_queued_rexmit_messages;
    }
    case Own::answer_is_kept:
      return *w.state().at(keeps_) != 0;
    case Own::some_answer_is_kept:
      return w.relation() == 0 && *w.state().at(keeps_) != 0;
    default:
      return until(mark_of(own), w.frame());
  }
}
void CyclonePacking::set(unsigned number, std::int64_t value, RuleRunner& w) {
  const Own own{static_cast<std::uint8_t>(number)};
  if (is_time(own)) {
    w.frame().erase_marks(mark_of(own), 0);
    w.frame().mark({mark_of(own)}, value);
  } else if (own == Own::heartbeats_since) {
    // Intervals do not grow beyond some number of HEARTBEATs.
    w.state().set(heartbeats_since_, std::min(value, most_heartbeats_));
  } else {
    *w.state().at(own == Own::ack_due ? ack_missed_ : heartbeat_missed_) = 0;
  }
}

std::int64_t CyclonePacking::until(What mark, Frame& frame) {
  const unsigned k = frame.find(mark);
  if (k == frame.count()) return 0;
  if (!frame.holds(k + 1, 0, 0)) return later + static_cast<std::int64_t>(mark);
  frame.erase(k);
  return 0;
}
/// It is only compared with the present, an interval later.
std::int64_t CyclonePacking::last_heartbeat(RuleRunner& w) {
  Frame& frame = w.frame();
  const unsigned k = frame.find(What::last_heartbeat);
  if (k == frame.count()) return -later;
  if (!frame.holds(k + 1, 0, -interval(w.state()))) return 0;
  frame.erase(k);
  return -later;
}
/// As long as a timer is scheduled, every other time may be the earlier one.
std::int64_t CyclonePacking::due(What what, bool missed) const {
  if (coming_ == what) return -rules_.of(what).shift;
  return missed ? -later : later + static_cast<std::int64_t>(What::again_at) + 1;
}

// Timers.

/// Of times of one timer, what is not before another one is forgotten.
bool CyclonePacking::moves(const Slot& slot, std::int64_t time, RuleRunner& w) {
  Frame& frame = w.frame();
  const unsigned added = frame.count();
  if (time < later) {
    frame.schedule(slot, time);
  } else if (const unsigned k = frame.find(static_cast<What>(time - later)); k < added) {
    frame.schedule_with(slot, k);
  }
  if (slot.what == What::thread_run) return true;
  for (unsigned n = frame.count(); n-- > added;) {
    for (unsigned k = n; k-- > 0;) {
      if (frame.slot(k).what != slot.what) continue;
      if (frame.zone().bound(k + 1, n + 1) <= 0) {
        frame.erase(n);
        break;
      }
      if (frame.zone().bound(n + 1, k + 1) > 0) continue;
      frame.erase(k);
      --n;
    }
  }
  return true;
}
void CyclonePacking::come(const Slot& slot, RuleRunner& w) {
  if (slot.what == What::thread_run) return w.run_at(slot.number, slot);
  coming_ = slot.what;
  w.run(slot, slot);
  coming_.reset();
  if (rules_.of(slot.what).shift != 0) {
    *w.state().at(missed(slot.what)) = 1;
    return;
  }
  for (unsigned k = w.frame().count(); k-- > 0;) {
    if (w.frame().slot(k).what == slot.what) w.frame().erase(k);
  }
}

// Events.

bool CyclonePacking::happens(const Slot& slot, RuleRunner& w) {
  switch (slot.what) {
    case What::reader_opens:
    case What::writer_opens:
      w.run(slot, slot);
      break;
    case What::creation:
      w.run(slot, static_cast<unsigned>(std::countr_zero(slot.set)));
      break;
    case What::data:
    case What::heartbeat:
    case What::acknack:
      receive(slot, w);
      break;
    default:
      come(slot, w);
  }
  settle(w);
  // What a reader that has replied acknowledges, it has received.
  const auto& states = program_.machine_of(program_.find("Peer")).states;
  if (states[*w.state().at(peer_)] != "Replied") return true;
  const auto acknowledged = (std::uint64_t{1} << w.state().get<std::int64_t>(acked_)) - 1;
  if ((acknowledged & ~std::uint64_t{w.state().get<Members>(received_)}) != 0) {
    w.frame().object(Claim::ack_implies_received);
  }
  return true;
}
/// Submessage by submessage.
void CyclonePacking::receive(const Slot& part, RuleRunner& w) {
  const bool at_writer = part.what == What::acknack;
  if (at_writer) w.run(part, part);
  if (part.what == What::data) {
    for (unsigned left = part.set; left != 0; left &= left - 1) {
      const Slot data{What::data, 0, static_cast<std::uint16_t>(left & -left)};
      w.run(data, data);
    }
  }
  if (part.what == What::heartbeat || part.has(Slot::carries_heartbeat)) {
    Slot heartbeat = part;
    heartbeat.what = What::heartbeat;
    w.run(heartbeat, heartbeat);
  }
  if (!part.has(Slot::goes_on)) w.raise("PacketEnds", at_writer ? 0 : 1);
}
std::string CyclonePacking::describe(const WorldState& state) const {
  const auto state_name = [&](std::string_view part, Kept kept) {
    return program_.machine_of(program_.find(part)).states[*state.at(kept)];
  };
  std::string bits;
  for (unsigned d = 0; d < scope().descriptors; ++d) {
    bits += (state.get<Members>(received_) & member(d)) != 0 ? '1' : '0';
  }
  return fmt::format("reader {}, X = {}; writer: {}, {} acknowledged", state_name("Judge", judge_),
                     bits, state_name("Peer", peer_), state.get<std::int64_t>(acked_));
}

std::unique_ptr<Packing> cyclone_packing(const fsm::program::Program& program,
                                         const model::Scenario& running, const Scope& scope,
                                         const EventRules& rules) {
  return std::make_unique<CyclonePacking>(program, running, scope, rules);
}

}  // namespace stormproof::explorer
