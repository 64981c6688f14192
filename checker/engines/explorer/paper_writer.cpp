// The writer side of the paper's relation: opening, HEARTBEATs, what an ACKNACK changes, repair and
// suppression. Each function stands for the function of the same name in model/paper/.
#include <bit>

#include "checker/engines/explorer/paper_world.hpp"

namespace stormproof::explorer {

namespace repair = fsm::descriptor_repair;
namespace timer = fsm::heartbeat_timer;

namespace {}  // namespace

template <class Event>
void PaperWorld::step_heartbeat(State& state, Frame& frame) {
  fsm::Stepper<fsm::HeartbeatTimer>::Input input;
  input.heartbeat_period = sedp_.heartbeat_period.count();
  input.additive = sedp_.heartbeat_timer == model::HeartbeatTimerKind::additive;
  input.pending = state.expiries;
  input.unacknowledged = state.has(State::writer_open) && state.unacknowledged > 0;
  const auto output = timer_.step<Event>(state.heartbeat, input);
  // To the only reader, if it is a recipient of the profile.
  const bool to_all = sedp_.heartbeat_recipients == model::HeartbeatRecipients::matched;
  if (output.send && (to_all || input.unacknowledged)) send_heartbeat(state, frame);
  if (output.schedule_expiry) {
    ++state.expiries;
    frame.schedule({What::heartbeat_expiry}, output.next_at);
  }
}

void PaperWorld::heartbeat_expiry(State& state, Frame& frame) {
  if (state.expiries > 0) --state.expiries;  // 0: the event was scheduled twice
  step_heartbeat<timer::Expired>(state, frame);
}

void PaperWorld::open_writer(State& state, Frame& frame) {
  state.flags |= State::writer_open;
  if (sedp_.initial_data == model::InitialData::push) generate_data(state, frame, all_, false);
  send_heartbeat(state, frame);
  step_heartbeat<timer::ArmRequested>(state, frame);
}

void PaperWorld::acknack_received(State& state, Frame& frame, const Slot& packet) {
  if (!state.has(State::writer_open)) return;
  if (packet.has(Slot::initial) && sedp_.initial_acknack != model::InitialAckNackReply::bitmap) {
    if (sedp_.initial_acknack == model::InitialAckNackReply::heartbeat) {
      send_heartbeat(state, frame);
    }
    return;
  }
  const std::uint16_t bitmap = live_bitmaps_ ? missing(state) : packet.set;
  if (bitmap != packet.set) frame.object(Claim::snapshot);
  state.asked |= packet.set;
  const unsigned first_missing = static_cast<unsigned>(std::countr_zero(bitmap));
  bool requested = false;
  for (unsigned d = 0; d < count_; ++d) {
    const bool listed = (bitmap & member(d)) != 0;
    const fsm::StateId before = state.repair[d];
    const auto output = descriptors_.step<repair::AckNackReceived>(
        state.repair[d], {.listed = listed,
                          .below_first_missing = d < first_missing,
                          .prefix_only = sedp_.acknowledge == model::Acknowledge::prefix});
    requested = requested || output.requested;
    constexpr fsm::StateId acknowledged = fsm::Reflect<fsm::DescriptorRepair>::id<repair::A>;
    if (before != acknowledged && state.repair[d] == acknowledged) --state.unacknowledged;
  }
  if (requested) {
    frame.schedule({What::repair_generation}, sedp_.nack_response_delay.count());
  }
}

void PaperWorld::repair_generation(State& state, Frame& frame) {
  std::uint16_t set = 0;
  for (unsigned d = 0; d < count_; ++d) {
    const auto output = descriptors_.step<repair::RepairDue>(state.repair[d], {});
    if (output.generate) set |= member(d);
  }
  if ((set & ~state.asked) != 0) frame.object(Claim::repair_only_if_asked);
  if (set != 0) generate_data(state, frame, set, true);
}

void PaperWorld::source_completion(State& state, Frame& frame, const Slot& packet) {
  for (unsigned d = 0; d < count_; ++d) {
    if ((packet.set & member(d)) == 0) continue;
    frame.erase_marks(What::repair_left, member(d));
    frame.mark({What::repair_left, 0, member(d)});
    descriptors_.step<repair::RepairSent>(state.repair[d], {});
  }
  frame.schedule({What::suppression_end}, sedp_.nack_suppression_duration.count());
}

void PaperWorld::suppression_end(State& state, Frame& frame) {
  bool returned = false;
  for (unsigned d = 0; d < count_; ++d) {
    const auto output = descriptors_.step<repair::SuppressionEnded>(state.repair[d], {});
    returned = returned || output.returned;
  }
  if (returned) step_heartbeat<timer::SuppressionEnded>(state, frame);
}

void PaperWorld::send_heartbeat(State& state, Frame& frame) {
  if (sedp_.piggyback != model::Piggyback::off) {
    state.budget = sedp_.piggyback_threshold_bytes.count();
  }
  frame.emit({What::heartbeat});
}

void PaperWorld::generate_data(State& state, Frame& frame, std::uint16_t set, bool repair) {
  const std::int64_t shared = sedp_.shared_header_bytes.count();
  const Slot empty{What::data, repair ? Slot::from_repair : std::uint8_t{0}};
  Slot packet = empty;
  std::int64_t payload_bytes = 0;
  const auto flush = [&] {
    frame.emit(packet);
    packet = empty;
    payload_bytes = 0;
  };
  for (unsigned d = 0; d < count_; ++d) {
    if ((set & member(d)) == 0) continue;
    const std::int64_t bytes = sizes_.bytes(model::Stream::pub, d);
    if (packet.set != 0 && packet_is_full(sedp_, payload_bytes, bytes - shared)) flush();
    const std::int64_t added = packet.set == 0 ? bytes : bytes - shared;
    if (frame.no_losses_yet() && (state.generated & member(d)) != 0) {
      frame.object(Claim::free_threshold);
    }
    state.generated |= member(d);
    state.asked &= static_cast<std::uint16_t>(~member(d));
    packet.set |= member(d);
    payload_bytes += added;
    charge(state, packet, payload_bytes, added);
  }
  if (packet.set != 0) flush();
}

/// The piggyback rule for a writer with one open relation: the HEARTBEAT rides in the packet.
void PaperWorld::charge(State& state, Slot& packet, std::int64_t& payload_bytes,
                        std::int64_t added) {
  if (sedp_.piggyback == model::Piggyback::off) return;
  const bool cumulative = sedp_.piggyback == model::Piggyback::cumulative;
  if (cumulative) state.sent_bytes += added;
  state.budget -= cumulative ? state.sent_bytes : added;
  if (state.budget >= 0) return;
  state.budget = sedp_.piggyback_threshold_bytes.count();
  const std::int64_t bytes = sedp_.piggyback_heartbeat_bytes.count();
  payload_bytes += bytes;
  packet.flags |= Slot::carries_heartbeat;
  if (cumulative) state.sent_bytes += bytes;
}

}  // namespace stormproof::explorer
