// The state of one relation, the dispatch of its events, its reader side, and what must hold after
// each event. Each function stands for the function of the same name in model/paper/.
#include "checker/engines/explorer/paper_world.hpp"

#include <bit>
#include <type_traits>

#include <fmt/core.h>

namespace stormproof::explorer {

namespace repair = fsm::descriptor_repair;
namespace reader = fsm::discovery_reader;
namespace timer = fsm::heartbeat_timer;
namespace initial_timer = fsm::initial_acknack;

namespace {

template <class Machine, class S>
constexpr fsm::StateId id = fsm::Reflect<Machine>::template id<S>;

/// From here on a delay of the initial ACKNACK that doubles stays as it is. Doubling without end,
/// the explored world would never come back to a state.

/// In the explored world user descriptors only: default ones differ in nothing but their size.
model::DescriptorProfile without_defaults(model::DescriptorProfile profile) {
  profile.default_publications = 0;
  profile.default_subscriptions = 0;
  return profile;
}

}  // namespace

static_assert(std::has_unique_object_representations_v<PaperWorld::State>);

PaperWorld::PaperWorld(const model::Scenario& scenario, const model::Scenario& specification,
                       const Scope& scope, const model::Mutation& mutation)
    : sedp_{scenario.dds.sedp},
      suppression_ns_{specification.dds.sedp.nack_suppression_duration.count()},
      scope_{scope},
      rules_{mutation.events, receives_separately},
      live_bitmaps_{mutation.live_bitmaps},
      accepts_unmatched_{sedp_.unmatched == model::Unmatched::accept ||
                         sedp_.relation_opening != model::RelationOpening::each_side},
      count_{scope.descriptors},
      all_{static_cast<std::uint16_t>((1U << scope.descriptors) - 1)},
      sizes_{without_defaults(scenario.dds.descriptors)},
      descriptors_{mutation.tables},
      reader_{mutation.tables},
      timer_{mutation.tables},
      initial_{mutation.tables} {}

PaperWorld::State PaperWorld::start(Frame& frame) {
  State state;
  state.budget =
      sedp_.piggyback == model::Piggyback::off ? 0 : sedp_.piggyback_threshold_bytes.count();
  for (fsm::StateId& s : state.repair) s = id<fsm::DescriptorRepair, repair::U>;
  state.heartbeat = id<fsm::HeartbeatTimer, timer::Idle>;
  state.reader = id<fsm::DiscoveryReader, reader::Unknown>;
  state.initial = id<fsm::InitialAckNack, initial_timer::Dormant>;
  state.unacknowledged = static_cast<std::uint8_t>(count_);
  if (!scope_.side_by_side) {
    frame.schedule({What::reader_opens}, 0);  // and the writer side with it
  } else {
    frame.schedule_between({What::reader_opens}, 0, scope_.largest_delay.count());
    frame.schedule_between({What::writer_opens}, 0, scope_.largest_delay.count());
  }
  return state;
}

void PaperWorld::fire(State& state, Frame& frame, const Slot& slot) {
  const State before = state;
  switch (slot.what) {
    case What::reader_opens:
      open_reader(state, frame);
      if (!scope_.side_by_side) open_writer(state, frame);
      break;
    case What::writer_opens:
      open_writer(state, frame);
      break;
    case What::data:
      data_received(state, frame, slot);
      break;
    case What::heartbeat:
      heartbeat_received(state, frame);
      break;
    case What::acknack:
      acknack_received(state, frame, slot);
      break;
    case What::source_completion:
      source_completion(state, frame, slot);
      break;
    case What::heartbeat_expiry:
      heartbeat_expiry(state, frame);
      break;
    case What::acknack_generation:
      acknack_generation(state, frame);
      break;
    case What::initial_acknack_due:
      initial_acknack_due(state, frame);
      break;
    case What::repair_generation:
      repair_generation(state, frame);
      break;
    case What::suppression_end:
      suppression_end(state, frame);
      break;
    default:
      break;
  }
  check_descriptors(before, state, frame);
  if (frame.pending(What::heartbeat_expiry) > 1) frame.object(Claim::single_heartbeat);
}

/// What must hold of the descriptors after each event.
void PaperWorld::check_descriptors(const State& before, const State& state, Frame& frame) {
  using States = fsm::Reflect<fsm::DescriptorRepair>;
  for (unsigned d = 0; d < count_; ++d) {
    const fsm::StateId s = state.repair[d];
    if (s == States::id<repair::A> && (state.received & member(d)) == 0) {
      frame.object(Claim::ack_implies_received);
    }
    if (s == States::id<repair::S>) continue;
    const bool returned = before.repair[d] == States::id<repair::S> && s == States::id<repair::U>;
    const unsigned left = frame.find_mark(What::repair_left, member(d));
    if (left == frame.count()) {
      if (returned) frame.object(Claim::suppression_honoured);  // it has not even left
      continue;
    }
    if (returned) frame.object_if(Claim::suppression_honoured, 0, left + 1, suppression_ns_ - 1);
    frame.erase_marks(What::repair_left, member(d));
  }
}

fsm::Stepper<fsm::DiscoveryReader>::Input PaperWorld::reader_input(std::uint16_t missing) const {
  return {.accepts_unmatched = accepts_unmatched_, .missing_after = std::popcount(missing)};
}

void PaperWorld::open_reader(State& state, Frame& frame) {
  const auto output =
      reader_.step<reader::AnnouncementReceived>(state.reader, reader_input(missing(state)));
  if (output.opened) step_initial<initial_timer::ReaderOpened>(state, frame);
}

template <class Event>
void PaperWorld::step_initial(State& state, Frame& frame) {
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

void PaperWorld::initial_acknack_due(State& state, Frame& frame) {
  step_initial<initial_timer::AttemptDue>(state, frame);
}

void PaperWorld::data_received(State& state, Frame& frame, const Slot& packet) {
  const std::uint16_t left = missing(state) & static_cast<std::uint16_t>(~packet.set);
  const auto output = reader_.step<reader::DataReceived>(state.reader, reader_input(left));
  if (frame.no_losses_yet() && (packet.set & state.received) != 0) {
    frame.object(Claim::single_copy);
  }
  if (output.take_data) state.received |= packet.set;
  if (packet.has(Slot::carries_heartbeat)) heartbeat_received(state, frame);
}

void PaperWorld::heartbeat_received(State& state, Frame& frame) {
  const auto output =
      reader_.step<reader::HeartbeatReceived>(state.reader, reader_input(missing(state)));
  if (!output.schedule_acknack) return;
  state.flags |= State::heartbeat_seen;
  frame.schedule({What::acknack_generation}, sedp_.heartbeat_response_delay.count());
}

void PaperWorld::acknack_generation(State& state, Frame& frame) {
  const auto output = reader_.step<reader::AckNackDue>(state.reader, reader_input(missing(state)));
  if (output.send_acknack) emit_acknack(state, frame, false);
}

void PaperWorld::emit_acknack(State& state, Frame& frame, bool initial) {
  frame.emit({What::acknack, initial ? Slot::initial : std::uint8_t{0}, missing(state)});
}

std::string PaperWorld::describe(const State& state) const {
  std::string text;
  for (unsigned d = 0; d < count_; ++d) {
    text += fmt::format("{}d{}: C = {}, X = {}", d == 0 ? "" : "; ", d,
                        fsm::Reflect<fsm::DescriptorRepair>::state_names[state.repair[d]],
                        (state.received & member(d)) != 0 ? 1 : 0);
  }
  return text;
}

}  // namespace stormproof::explorer
