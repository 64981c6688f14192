// The state of one relation of Fast DDS, the dispatch of its events, its reader side, and what must
// hold after each event; each function stands for the function of the same name in model/fastdds/.
#include "checker/engines/explorer/fastdds_world.hpp"

#include <algorithm>
#include <bit>
#include <type_traits>

#include <fmt/core.h>

namespace stormproof::explorer {

namespace change = fsm::change_for_reader;
namespace reader = fsm::discovery_reader;
namespace timer = fsm::heartbeat_timer;
namespace initial_timer = fsm::initial_acknack;
namespace single_shot = fsm::single_shot;

namespace {

using Changes = fsm::Reflect<fsm::ChangeForReader>;

/// From here on a delay of the initial ACKNACK that doubles stays as it is, so that the explored
/// world is finite.

constexpr std::uint16_t below(unsigned d) { return static_cast<std::uint16_t>(member(d) - 1); }

}  // namespace

static_assert(std::has_unique_object_representations_v<FastDdsWorld::State>);

model::Nanoseconds FastDdsWorld::creation_distance(const model::Scenario& scenario) {
  const std::int64_t suppression = scenario.dds.sedp.nack_suppression_duration.count();
  return model::Nanoseconds{std::max<std::int64_t>(1, suppression / 2)};
}

FastDdsWorld::FastDdsWorld(const model::Scenario& scenario, const model::Scenario& specification,
                           const Scope& scope, const model::Mutation& mutation)
    : sedp_{scenario.dds.sedp},
      suppression_ns_{specification.dds.sedp.nack_suppression_duration.count()},
      scope_{scope},
      rules_{mutation.events, receives_separately},
      live_bitmaps_{mutation.live_bitmaps},
      creation_distance_{creation_distance(scenario)},
      changes_{mutation.tables},
      reader_{mutation.tables},
      timer_{mutation.tables},
      initial_{mutation.tables},
      shots_{mutation.tables} {}

FastDdsWorld::State FastDdsWorld::start(Frame& frame) {
  State state;
  state.changes.fill(Changes::id<change::Absent>);
  state.created = static_cast<std::uint8_t>(descriptor_count - scope_.pushed);
  state.heartbeat = fsm::Reflect<fsm::HeartbeatTimer>::id<timer::Idle>;
  state.reader = fsm::Reflect<fsm::DiscoveryReader>::id<reader::Unknown>;
  state.initial = fsm::Reflect<fsm::InitialAckNack>::id<initial_timer::Dormant>;
  for (fsm::StateId* shot :
       {&state.nack_response, &state.async_run, &state.suppression, &state.reply}) {
    *shot = fsm::Reflect<fsm::SingleShot>::id<single_shot::Idle>;
  }
  const std::int64_t delta = scope_.largest_delay.count();
  const std::int64_t apart = scope_.side_by_side ? delta : 0;
  if (scope_.pushed == 1) {
    frame.schedule_between({What::creation, 0, member(descriptor_count - 1)}, 0, delta);
  } else if (scope_.pushed == 2) {
    // The two creations keep their distance, so their order is certain.
    frame.schedule_between({What::creation, 0, member(descriptor_count - 2)}, 0,
                           creation_distance_.count());
  }
  frame.schedule_between({What::reader_opens}, 0, apart);
  frame.schedule_between({What::writer_opens}, 0, apart);
  return state;
}

void FastDdsWorld::fire(State& state, Frame& frame, const Slot& slot) {
  const State before = state;
  switch (slot.what) {
    case What::reader_opens:
      open_reader(state, frame);
      break;
    case What::writer_opens:
      open_writer(state, frame);
      break;
    case What::creation:
      create(state, frame, slot.set);
      break;
    case What::data:
      data_received(state, slot, frame);
      break;
    case What::heartbeat:
      heartbeat_received(state, frame, slot.number);
      break;
    case What::acknack:
      acknack_received(state, frame, slot);
      break;
    case What::heartbeat_expiry:
      heartbeat_expiry(state, frame);
      break;
    case What::acknack_generation:
      acknack_generation(state, frame);
      break;
    case What::initial_acknack_due:
      step_initial<initial_timer::AttemptDue>(state, frame);
      break;
    case What::suppression_end:
      suppression_end(state, frame);
      break;
    case What::nack_response:
      nack_response(state, frame);
      break;
    case What::async_run:
      async_run(state, frame);
      break;
    default:
      break;
  }
  check_descriptors(before, state, frame);
  if (frame.pending(What::heartbeat_expiry) > 1) frame.object(Claim::single_heartbeat);
}

void FastDdsWorld::check_descriptors(const State& before, const State& state, Frame& frame) {
  for (unsigned d = 0; d < descriptor_count; ++d) {
    const fsm::StateId s = state.changes[d];
    if (s == Changes::id<change::A> && (state.received & member(d)) == 0) {
      frame.object(Claim::ack_implies_received);
    }
    if (s == Changes::id<change::S>) continue;
    const bool returned =
        before.changes[d] == Changes::id<change::S> && s == Changes::id<change::U>;
    for (unsigned k = 0; returned && k < frame.count(); ++k) {
      if (frame.slot(k).what != What::repair_left || (frame.slot(k).set & member(d)) == 0) continue;
      frame.object_if(Claim::suppression_honoured, 0, k + 1, suppression_ns_ - 1);
    }
  }
  // A mark stays as long as one of its descriptors is suppressed.
  std::uint16_t suppressed = 0;
  for (unsigned d = 0; d < descriptor_count; ++d) {
    if (state.changes[d] == Changes::id<change::S>) suppressed |= member(d);
  }
  for (unsigned k = frame.count(); k-- > 0;) {
    const Slot slot = frame.slot(k);
    if (slot.what == What::repair_left && (slot.set & suppressed) == 0) {
      frame.erase_marks(What::repair_left, slot.set);
      k = std::min(k, frame.count());
    }
  }
}

fsm::Stepper<fsm::DiscoveryReader>::Input FastDdsWorld::reader_input(std::uint16_t missing) const {
  return {.accepts_unmatched = false, .missing_after = std::popcount(missing)};
}

void FastDdsWorld::request(fsm::StateId& timer, Frame& frame, What what, model::Nanoseconds delay) {
  const auto output =
      shots_.step<single_shot::Requested>(timer, {.now = 0, .delay = delay.count()});
  if (output.schedule) frame.schedule({what}, output.next_at);
}

bool FastDdsWorld::expire(fsm::StateId& timer) {
  return shots_.step<single_shot::Due>(timer, {.now = 0, .delay = 0}).fire;
}

void FastDdsWorld::open_reader(State& state, Frame& frame) {
  const auto output =
      reader_.step<reader::AnnouncementReceived>(state.reader, reader_input(missing(state)));
  if (output.opened) step_initial<initial_timer::ReaderOpened>(state, frame);
}

template <class Event>
void FastDdsWorld::step_initial(State& state, Frame& frame) {
  const std::int64_t first = sedp_.initial_acknack_delay.count();
  const bool constant = sedp_.initial_acknack_interval == model::InitialAckNackInterval::constant;
  const auto output =
      initial_.step<Event>(state.initial, {.now = 0,
                                           .first_delay = first,
                                           .last_delay = first << state.attempts,
                                           .heartbeat_seen = state.has(State::heartbeat_seen),
                                           .constant = constant});
  if (output.attempt) {
    if (!constant && state.attempts < last_doubling) ++state.attempts;
    const auto asked =
        reader_.step<reader::InitialAckNackDue>(state.reader, reader_input(missing(state)));
    if (asked.send_initial) emit_acknack(state, frame, true);
  }
  if (output.schedule) frame.schedule({What::initial_acknack_due}, output.next_at);
}

void FastDdsWorld::data_received(State& state, const Slot& packet, Frame& frame) {
  const auto left = static_cast<std::uint16_t>(missing(state) & ~packet.set);
  const auto output = reader_.step<reader::DataReceived>(state.reader, reader_input(left));
  if (!output.take_data) return;
  if (frame.no_losses_yet() && (packet.set & state.received) != 0) {
    frame.object(Claim::single_copy);
  }
  state.received |= packet.set;
  state.announced =
      std::max(state.announced, static_cast<std::uint8_t>(std::bit_width(packet.set)));
}

void FastDdsWorld::heartbeat_received(State& state, Frame& frame, std::uint8_t announced) {
  const auto output =
      reader_.step<reader::HeartbeatReceived>(state.reader, reader_input(missing(state)));
  if (!output.schedule_acknack) return;
  state.flags |= State::heartbeat_seen;
  state.announced = std::max(state.announced, announced);
  request(state.reply, frame, What::acknack_generation, sedp_.heartbeat_response_delay);
}

void FastDdsWorld::acknack_generation(State& state, Frame& frame) {
  if (!expire(state.reply)) return;
  const auto output = reader_.step<reader::AckNackDue>(state.reader, reader_input(missing(state)));
  if (output.send_acknack) emit_acknack(state, frame, false);
}

void FastDdsWorld::emit_acknack(State& state, Frame& frame, bool initial) {
  if (initial) {
    frame.emit({What::acknack, Slot::initial});
    return;
  }
  const auto base = static_cast<std::uint8_t>(
      std::min<int>(std::countr_zero(missing(state)), static_cast<int>(descriptor_count)));
  frame.emit({What::acknack, 0, static_cast<std::uint16_t>(missing(state) & below(state.announced)),
              base});
}

std::string FastDdsWorld::describe(const State& state) const {
  std::string text = "C = ";
  for (const fsm::StateId s : state.changes) {
    text += s == Changes::id<change::Absent> ? "-" : Changes::state_names[s];
  }
  text += ", X = ";
  for (unsigned d = 0; d < descriptor_count; ++d) {
    text += (state.received & member(d)) != 0 ? '1' : '0';
  }
  return text;
}

}  // namespace stormproof::explorer
