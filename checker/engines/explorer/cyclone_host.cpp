// What Cyclone DDS's rules leave to the explorer: times, timers, and the event threads.
#include "checker/engines/explorer/cyclone_host.hpp"

#include <algorithm>
#include <bit>
#include <vector>

#include "checker/engines/explorer/cyclone_messages.hpp"

namespace stormproof::explorer {

namespace cyclone = comp::cyclone;

namespace {

/// Beyond the end of time; a number of a mark beyond that is the time of the mark.
constexpr std::int64_t later = std::int64_t{1} << 60;

std::int64_t interval_of(const model::DdsProfile& dds, std::int64_t number) {
  fsm::HeartbeatPacerIo::Input<fsm::Plain> in;
  in.interval = model::knob_value(cyclone::HeartbeatInterval{}, dds);
  in.interval_max = model::knob_value(cyclone::HeartbeatIntervalMax{}, dds);
  return fsm::heartbeat_pacer::interval_after<fsm::Plain>(in, number);
}
/// After so many HEARTBEATs intervals do not grow any more.
std::int64_t most_heartbeats(const model::DdsProfile& dds) {
  constexpr std::int64_t enough = 200;
  std::int64_t number = 0;
  while (interval_of(dds, number) < interval_of(dds, enough)) ++number;
  return number;
}

constexpr bool carries_heartbeat(const Slot& slot) {
  return slot.what == What::heartbeat ||
         (slot.what == What::data && slot.has(Slot::carries_heartbeat));
}
/// Its count is compared with others of `kind`: HEARTBEATs, or ACKNACKs that are not pre-emptive.
constexpr bool is_counted(const Slot& slot, What kind) {
  if (kind == What::heartbeat) return carries_heartbeat(slot);
  return slot.what == What::acknack && !slot.has(Slot::initial);
}

}  // namespace

CycloneHost::CycloneHost(const model::Scenario& running, const Scope& scope,
                         const EventRules& rules, const model::Mutation& mutation)
    : dds_{running.dds},
      samples_{scope.descriptors},
      rules_{rules},
      machines_{mutation.tables},
      mutation_{mutation},
      most_heartbeats_{most_heartbeats(running.dds)} {}

// Times.

std::int64_t CycloneHost::until(What what) {
  const unsigned k = frame_->find(what);
  if (k == frame_->count()) return 0;
  if (!frame_->holds(k + 1, 0, 0)) return later + static_cast<std::int64_t>(what);
  frame_->erase(k);
  return 0;
}
std::int64_t CycloneHost::interval() const {
  return interval_of(dds_, state_->get<cyclone::HeartbeatsSince>());
}
/// It is only compared with the present, an interval later.
std::int64_t CycloneHost::last_heartbeat() {
  const unsigned k = frame_->find(What::last_heartbeat);
  if (k == frame_->count()) return -later;
  if (!frame_->holds(k + 1, 0, -interval())) return 0;
  frame_->erase(k);
  return -later;
}

// Timers.

/// As long as a timer is scheduled, every other time may be the earlier one.
std::int64_t CycloneHost::due(What what, bool missed) const {
  if (coming_ == what) return -rules_.of(what).shift;
  return missed ? -later : later + static_cast<std::int64_t>(What::again_at) + 1;
}
/// Of times of one timer, what is not before another one is forgotten.
void CycloneHost::schedule(Slot slot, std::int64_t time) {
  const unsigned added = frame_->count();
  if (time < later) {
    frame_->schedule(slot, time);
  } else if (const unsigned k = frame_->find(static_cast<What>(time - later)); k < added) {
    frame_->schedule_with(slot, k);
  }
  if (slot.what == What::thread_run) return;
  for (unsigned n = frame_->count(); n-- > added;) {
    for (unsigned k = n; k-- > 0;) {
      if (frame_->slot(k).what != slot.what) continue;
      if (frame_->zone().bound(k + 1, n + 1) <= 0) {
        frame_->erase(n);
        break;
      }
      if (frame_->zone().bound(n + 1, k + 1) > 0) continue;
      frame_->erase(k);
      --n;
    }
  }
}
void CycloneHost::come(const Slot& slot) {
  if (slot.what == What::thread_run) return run_rule<comp::Due<cyclone::ThreadRun>>(slot.number);
  const bool of_writer = slot.what == What::heartbeat_time;
  coming_ = slot.what;
  if (of_writer) {
    run_rule<comp::Due<cyclone::HeartbeatTime>>(0);
  } else {
    run_rule<comp::Due<cyclone::AckTime>>(0);
  }
  coming_.reset();
  if (rules_.of(slot.what).shift == 0) {
    for (unsigned k = frame_->count(); k-- > 0;) {
      if (frame_->slot(k).what == slot.what) frame_->erase(k);
    }
  } else if (of_writer) {
    state_->set<cyclone_parts::HeartbeatTimeMissed>(true);
  } else {
    state_->set<cyclone_parts::AckTimeMissed>(true);
  }
}

// Messages.

bool CycloneHost::is_queued(Number d) const {
  return std::ranges::any_of(std::span{state_->queue}.first(state_->queued), [d](const Slot& m) {
    return m.what == What::data && m.has(Slot::from_repair) && m.set == member(d);
  });
}
unsigned CycloneHost::queued_repairs() const {
  const auto queue = std::span{state_->queue}.first(state_->queued);
  return static_cast<unsigned>(
      std::ranges::count_if(queue, [](const Slot& m) { return m.has(Slot::from_repair); }));
}
/// DATA is queued, an answer is kept, and the rest is what a timer gives to its thread.
void CycloneHost::leave(Slot message) {
  if (message.what == What::data) {
    if (!message.has(Slot::to_set)) message.flags |= Slot::from_repair;
    enqueue(message);
  } else if (message.has(Slot::directed)) {
    state_->kept = message;
    state_->keeps = 1;
  } else {
    if (!works_) frame_->overflow();  // a mistake that is not explored
    given_.push_back(message);
  }
}
void CycloneHost::enqueue(const Slot& message) {
  if (state_->queued == state_->queue.size()) return frame_->overflow();
  state_->queue[state_->queued++] = message;
}
void CycloneHost::let_answer_go() {
  if (state_->keeps == 0) return;
  enqueue(state_->kept);
  state_->kept = {};
  state_->keeps = 0;
}
void CycloneHost::note_asked() {
  if (packet_ == nullptr) return;
  state_->set<Asked>(state_->get<Asked>() | packet_->set);
}

// The thread (model/cyclone/sender.cpp, if sending takes no time).

void CycloneHost::work(Number i) {
  model::cyclone::Packer packer{dds_.sedp};
  works_ = true;
  while (true) {
    packer.open_held();
    if (!next_task(i)) {
      if (!packer.has_open()) break;
      send(packer.take_open());
      continue;
    }
    while (!given_.empty() && !packer.is_complete()) {
      packer.add(message_of(given_.front()));
      given_.pop_front();
    }
    if (packer.is_complete()) send(packer.take_open());
  }
  works_ = false;
  run_rule<comp::Happens<cyclone::ThreadSleeps>>(i);
}
bool CycloneHost::next_task(Number i) {
  if (!given_.empty()) return true;
  if (state_->listed[i] > 0) {
    --state_->listed[i];
    if (i == 0) {
      run_rule<comp::Happens<cyclone::HeartbeatTimerFires>>(0);
    } else {
      run_rule<comp::Happens<cyclone::AckTimerFires>>(0);
    }
    return true;
  }
  if (i != 0 || state_->queued == 0) return false;
  given_.push_back(state_->queue.front());
  std::ranges::copy(state_->queue.begin() + 1, state_->queue.end(), state_->queue.begin());
  state_->queue[--state_->queued] = {};
  return true;
}
void CycloneHost::send(const model::cyclone::Bundle& bundle) {
  for (const model::Submessage& m : bundle.contents) {
    if (m.kind != model::Submessage::Kind::data) continue;
    const auto up_to = static_cast<Members>(member(m.sample + 1) - 1);
    state_->set<cyclone::Sent>(state_->get<cyclone::Sent>() | up_to);
    const Members it = member(m.sample);
    const Members asked = state_->get<Asked>();
    object_to_generated(*frame_, it, !bundle.to.is_set, asked, state_->get<Generated>());
    state_->set<Generated>(state_->get<Generated>() | it);
    state_->set<Asked>(asked & static_cast<Members>(~it));
  }
  const std::vector<Slot> parts = parts_of(bundle.contents);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (k == 0) {
      frame_->emit(parts[k]);
    } else {
      frame_->emit_part(parts[k]);
    }
  }
}

// What is over.

void CycloneHost::settle() {
  for (unsigned k = frame_->count(); k-- > 0;) {
    const What what = frame_->slot(k).what;
    if (!is_mark(what) || what <= What::completed) continue;
    const std::int64_t end = what == What::last_heartbeat ? -interval() : 0;
    if (frame_->zone().bound(k + 1, 0) <= end) frame_->erase(k);
  }
  keep_counts_small<cyclone::HeartbeatCount, cyclone::LastHeartbeatCount>(What::heartbeat);
  keep_counts_small<cyclone::NextAckCount, cyclone::LastAckCount>(What::acknack);
}
/// What is under way and `Made`, the last count that was given, are numbered from 1; `Last`, the
/// last one that was accepted, is only compared with them.
template <class Made, class Last>
void CycloneHost::keep_counts_small(What kind) {
  std::vector<std::int64_t> counts;
  if (state_->get<Made>() > 0) counts.push_back(state_->get<Made>());
  for (unsigned k = 0; k < frame_->count(); ++k) {
    if (is_counted(frame_->slot(k), kind)) counts.push_back(frame_->slot(k).count);
  }
  const auto waiting = std::span{state_->queue}.first(state_->queued);
  for (const Slot& m : waiting) {
    if (is_counted(m, kind)) counts.push_back(m.count);
  }
  if (state_->keeps != 0 && kind == What::heartbeat) counts.push_back(state_->kept.count);
  std::ranges::sort(counts);
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
  const auto small = [&](std::int64_t count) {
    return std::ranges::upper_bound(counts, count) - counts.begin();
  };
  const auto renew = [&](Slot& m) {
    if (is_counted(m, kind)) m.count = static_cast<std::uint16_t>(small(m.count));
  };
  state_->set<Made>(small(state_->get<Made>()));
  state_->set<Last>(small(state_->get<Last>()));
  for (unsigned k = 0; k < frame_->count(); ++k) {
    Slot renewed = frame_->slot(k);
    renew(renewed);
    frame_->set_count(k, renewed.count);
  }
  for (Slot& m : std::span{state_->queue}.first(state_->queued)) renew(m);
  if (state_->keeps != 0) renew(state_->kept);
}

}  // namespace stormproof::explorer
