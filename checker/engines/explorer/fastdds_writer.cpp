// The writer side of Fast DDS's relation: match, creation, HEARTBEATs, what an ACKNACK changes, the
// nack response, the async run and suppression. Each function stands for the function of the same
// name in model/fastdds/.
#include <algorithm>
#include <bit>

#include "checker/engines/explorer/fastdds_world.hpp"

namespace stormproof::explorer {

namespace change = fsm::change_for_reader;
namespace timer = fsm::heartbeat_timer;

namespace {
using Changes = fsm::Reflect<fsm::ChangeForReader>;

}  // namespace

template <class Event>
void FastDdsWorld::step_heartbeat(State& state, Frame& frame) {
  fsm::Stepper<fsm::HeartbeatTimer>::Input input;
  input.heartbeat_period = sedp_.heartbeat_period.count();
  input.pending = state.expiries;
  input.unacknowledged = needs_heartbeat(state);
  const auto output = timer_.step<Event>(state.heartbeat, input);
  if (output.send) send_heartbeat(state, frame);
  if (output.schedule_expiry) {
    ++state.expiries;
    frame.schedule({What::heartbeat_expiry}, output.next_at);
  }
}

void FastDdsWorld::heartbeat_expiry(State& state, Frame& frame) {
  if (state.expiries > 0) --state.expiries;  // 0: the event was scheduled twice
  step_heartbeat<timer::Expired>(state, frame);
}

void FastDdsWorld::open_writer(State& state, Frame& frame) {
  state.flags |= State::matched;
  for (unsigned d = 0; d < state.created; ++d) {
    changes_.step<change::ReaderMatched>(state.changes[d], {});
  }
  if (state.created > 0) step_heartbeat<timer::ArmRequested>(state, frame);
  send_heartbeat(state, frame);
}

void FastDdsWorld::create(State& state, Frame& frame, std::uint16_t set) {
  const auto d = static_cast<unsigned>(std::countr_zero(set));
  state.created = static_cast<std::uint8_t>(d + 1);
  if (state.has(State::matched)) {
    changes_.step<change::Created>(state.changes[d], {});
    deliver(state, frame, d);
    frame.mark({What::repair_left, 0, member(d)});
    frame.emit({What::data, 0, member(d)});
  }
  if (scope_.pushed == 2 && d + 2 == descriptor_count) {
    frame.schedule({What::creation, 0, member(d + 1)}, creation_distance_.count());
  }
}

/// The descriptor is put into a message.
void FastDdsWorld::deliver(State& state, Frame& frame, unsigned d) {
  changes_.step<change::Serialized>(state.changes[d], {});
  request(state.suppression, frame, What::suppression_end, sedp_.nack_suppression_duration);
  if (frame.no_losses_yet() && (state.generated & member(d)) != 0) {
    frame.object(Claim::free_threshold);
  }
  state.generated |= member(d);
  state.asked &= static_cast<std::uint16_t>(~member(d));
  step_heartbeat<timer::ArmRequested>(state, frame);
}

bool FastDdsWorld::needs_heartbeat(const State& state) const {
  if (!state.has(State::matched)) return false;
  if (state.created > 0 && state.low == 0) return true;
  return std::ranges::any_of(state.changes,
                             [](fsm::StateId s) { return s == Changes::id<change::U>; });
}

void FastDdsWorld::send_heartbeat(const State& state, Frame& frame) {
  frame.emit({What::heartbeat, 0, 0, state.created});
}

void FastDdsWorld::acknack_received(State& state, Frame& frame, const Slot& packet) {
  if (!state.has(State::matched)) return;
  if (packet.has(Slot::initial)) {
    for (fsm::StateId& s : state.changes) changes_.step<change::InitialAckNackReceived>(s, {});
    state.low = 0;
    send_heartbeat(state, frame);
    step_heartbeat<timer::ArmRequested>(state, frame);
    return;
  }
  std::uint16_t bitmap = packet.set;
  if (live_bitmaps_) bitmap &= missing(state);
  if (bitmap != packet.set) frame.object(Claim::snapshot);
  state.asked |= packet.set;
  bool requested = false;
  for (unsigned d = 0; d < descriptor_count; ++d) {
    const bool below_base = d < packet.number;
    if (!below_base && (bitmap & member(d)) == 0) continue;
    const auto output = changes_.step<change::AckNackReceived>(
        state.changes[d], {.listed = !below_base, .below_base = below_base});
    requested = requested || output.requested;
  }
  state.low = std::max(state.low, packet.number);
  if (requested) {
    request(state.nack_response, frame, What::nack_response, sedp_.nack_response_delay);
  } else if (bitmap != 0) {
    step_heartbeat<timer::ArmRequested>(state, frame);
  }
}

void FastDdsWorld::nack_response(State& state, Frame& frame) {
  if (!expire(state.nack_response)) return;
  for (unsigned d = 0; d < descriptor_count; ++d) {
    const auto output = changes_.step<change::NackResponseDue>(state.changes[d], {});
    if (output.enqueue) state.queued |= member(d);
  }
  if (state.queued != 0) {
    request(state.async_run, frame, What::async_run, model::Nanoseconds{0});
  }
}

void FastDdsWorld::async_run(State& state, Frame& frame) {
  if (!expire(state.async_run)) return;
  std::uint16_t sent = 0;
  for (unsigned d = 0; d < descriptor_count; ++d) {
    if ((state.queued & member(d)) == 0 || state.changes[d] != Changes::id<change::Q>) continue;
    if ((state.asked & member(d)) == 0) frame.object(Claim::repair_only_if_asked);
    deliver(state, frame, d);
    sent |= member(d);
  }
  state.queued = 0;
  if (sent == 0) return;
  frame.mark({What::repair_left, 0, sent});
  frame.emit({What::data, 0, sent});
}

void FastDdsWorld::suppression_end(State& state, Frame& frame) {
  if (!expire(state.suppression)) return;
  for (fsm::StateId& s : state.changes) changes_.step<change::SuppressionEnded>(s, {});
  step_heartbeat<timer::ArmRequested>(state, frame);
}

}  // namespace stormproof::explorer
