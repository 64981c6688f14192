// From events to Cyclone DDS's rules.
#include "checker/engines/explorer/cyclone_world.hpp"

#include <bit>

#include <fmt/core.h>

#include "fsm/reflect.hpp"

namespace stormproof::explorer {

namespace {

namespace cyclone = comp::cyclone;

template <class P>
std::string_view state_name(const CycloneState& state) {
  return fsm::Reflect<typename P::Machine>::state_names[state.state<P>()];
}

/// What a reader that has replied acknowledges, it has received.
void check_acknowledgment(const CycloneState& state, Frame& frame) {
  constexpr fsm::StateId replied =
      fsm::Reflect<fsm::MatchedReader>::id<fsm::matched_reader::Replied>;
  if (state.state<cyclone::Peer>() != replied) return;
  const auto acknowledged = (1U << state.get<cyclone::Acked>()) - 1;
  if ((acknowledged & ~unsigned{state.get<comp::X>()}) != 0) {
    frame.object(Claim::ack_implies_received);
  }
}

}  // namespace

CycloneWorld::CycloneWorld(const model::Scenario& running, const model::Scenario&,
                           const Scope& scope, const model::Mutation& mutation)
    : scope_{scope}, rules_{mutation.events, true}, host_{running, scope, rules_, mutation} {}

/// All samples exist but those that are created after the match. The two sides open apart.
CycloneState CycloneWorld::start(Frame& frame) {
  static_assert(std::has_unique_object_representations_v<State>);
  State state;
  const auto exist = static_cast<Members>(member(scope_.descriptors - scope_.pushed) - 1);
  state.set<cyclone::Exists>(exist);
  state.set<cyclone::Sent>(exist);
  const std::int64_t apart = scope_.side_by_side ? scope_.largest_delay.count() : 0;
  frame.schedule_between({What::reader_opens}, 0, apart);
  frame.schedule_between({What::writer_opens}, 0, apart);
  if (scope_.pushed > 0) {
    frame.schedule_between({What::creation, 0, member(scope_.descriptors - 1)}, 0,
                           scope_.largest_delay.count());
  }
  return state;
}

void CycloneWorld::fire(State& state, Frame& frame, const Slot& slot) {
  host_.go_on_with(state, frame);
  happen(slot);
  host_.settle();
  check_acknowledgment(state, frame);
}

void CycloneWorld::happen(const Slot& slot) {
  switch (slot.what) {
    case What::reader_opens:
      host_.run_rule<comp::Happens<comp::ReaderOpens>>(0);
      break;
    case What::writer_opens:
      host_.run_rule<comp::Happens<cyclone::WriterOpens>>(0);
      break;
    case What::creation:
      host_.run_rule<comp::Happens<cyclone::Created>>(
          0, nullptr, static_cast<std::uint32_t>(std::countr_zero(slot.set)));
      break;
    case What::data:
    case What::heartbeat:
    case What::acknack:
      receive(slot);
      break;
    default:
      host_.come(slot);
  }
}

/// Submessage by submessage.
void CycloneWorld::receive(const Slot& part) {
  const bool at_writer = part.what == What::acknack;
  if (at_writer) host_.run_rule<comp::Received<cyclone::AckNack>>(0, &part);
  if (part.what == What::data) {
    for (unsigned left = part.set; left != 0; left &= left - 1) {
      const Slot data{What::data, 0, static_cast<std::uint16_t>(left & -left)};
      host_.run_rule<comp::Received<cyclone::Data>>(0, &data);
    }
  }
  if (part.what == What::heartbeat || part.has(Slot::carries_heartbeat)) {
    Slot heartbeat = part;
    heartbeat.what = What::heartbeat;
    host_.run_rule<comp::Received<cyclone::Heartbeat>>(0, &heartbeat);
  }
  if (!part.has(Slot::goes_on))
    host_.run_rule<comp::Happens<cyclone::PacketEnds>>(at_writer ? 0 : 1);
}

std::string CycloneWorld::describe(const State& state) const {
  std::string bits;
  for (unsigned d = 0; d < scope_.descriptors; ++d) {
    bits += (state.get<comp::X>() & member(d)) != 0 ? '1' : '0';
  }
  return fmt::format("reader {}, X = {}; writer: {}, {} acknowledged",
                     state_name<cyclone::Judge>(state), bits, state_name<cyclone::Peer>(state),
                     state.get<cyclone::Acked>());
}

}  // namespace stormproof::explorer
