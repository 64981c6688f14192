// What the explorer objects to, whatever the implementation: that a repair was asked for, that an
// ACKNACK arrives as it was emitted, copies and repairs without a loss, the suppression of what has
// been repaired, and what is acknowledged. Stalls, completion and silence are the search's own
// (checker/engines/explorer/search.hpp).
#pragma once

#include <algorithm>
#include <bit>
#include <optional>
#include <string_view>

#include "checker/engines/explorer/frame.hpp"
#include "checker/engines/explorer/world_state.hpp"
#include "fsm/reflect.hpp"

namespace stormproof::explorer {

/// These descriptors are generated for the relation's reader, in answer to an ACKNACK if it is a
/// repair.
template <class State>
void note_generated(State& state, Frame& frame, unsigned relation, Members members, bool repair) {
  frame.count_generated(static_cast<unsigned>(std::popcount(members)));
  const Members asked = state.template get<Asked>(relation);
  const Members generated = state.template get<Generated>(relation);
  if (repair && (members & ~asked) != 0) frame.object(Claim::repair_only_if_asked);
  if (frame.no_losses_yet() && (members & generated) != 0) frame.object(Claim::free_threshold);
  state.template set<Generated>(generated | members, relation);
  state.template set<Asked>(asked & static_cast<Members>(~members), relation);
}

/// An ACKNACK is emitted whose reader lacks what is not in X. `announced`: those that it has heard
/// of, if it lists no others, and its base is the first that it lacks; then an initial ACKNACK
/// claims nothing.
template <class State>
void note_listed(const State& state, Frame& frame, const Slot& acknack, unsigned descriptors,
                 std::optional<Members> announced) {
  const auto received = std::uint32_t{state.template get<comp::X>(acknack.relation)};
  const bool claims = !announced || !acknack.has(Slot::initial);
  const std::uint32_t lacking = ~received & announced.value_or(member(descriptors) - 1);
  const auto first = std::min(static_cast<unsigned>(std::countr_one(received)), descriptors);
  if (acknack.set != (claims ? lacking : 0)) frame.object(Claim::snapshot);
  if (announced && acknack.number != (claims ? first : 0)) frame.object(Claim::snapshot);
}

/// The writer takes `listed` from an ACKNACK of its reader, which has been emitted as `emitted`.
template <class State>
void note_asked(State& state, Frame& frame, unsigned relation, Members listed,
                const Slot& emitted) {
  if (listed != emitted.set) frame.object(Claim::snapshot);
  state.template set<Asked>(state.template get<Asked>(relation) | listed, relation);
}

/// The reader is about to take these.
template <class State>
void note_copies(const State& state, Frame& frame, unsigned relation, Members carried) {
  const bool again = (carried & state.template get<comp::X>(relation)) != 0;
  if (again && frame.no_losses_yet()) frame.object(Claim::single_copy);
}

/// The suppression of these begins, towards the relation's reader.
inline void note_left(Frame& frame, unsigned relation, Members members) {
  frame.erase_marks(What::repair_left, members, relation);
  frame.mark({What::repair_left, 0, members, 0, static_cast<std::uint8_t>(relation)});
}

/// What must hold of the descriptors of a relation after each event; they have to be suppressed
/// for `suppression` ns. `C` is the writer's view of them.
template <class C, class State>
void check_descriptors(const State& before, const State& state, Frame& frame, unsigned relation,
                       std::int64_t suppression) {
  // By the paper's letters.
  constexpr auto letter = [](std::string_view name) {
    const auto& names = fsm::Reflect<typename C::Machine>::state_names;
    return static_cast<fsm::StateId>(std::ranges::find(names, name) - names.begin());
  };
  constexpr fsm::StateId u = letter("U");
  constexpr fsm::StateId s = letter("S");
  constexpr fsm::StateId a = letter("A");
  if ((state.template in_state<C>(a, relation) & ~state.template get<comp::X>(relation)) != 0) {
    frame.object(Claim::ack_implies_received);
  }
  const unsigned returned =
      before.template in_state<C>(s, relation) & state.template in_state<C>(u, relation);
  const auto is_mark_of = [relation](const Slot& slot) {
    return slot.what == What::repair_left && slot.relation == relation;
  };
  for (unsigned left = returned; left != 0; left &= left - 1) {
    bool has_left = false;
    for (unsigned k = 0; k < frame.count(); ++k) {
      const Slot& mark = frame.slot(k);
      if (!is_mark_of(mark) || (mark.set & left & -left) == 0) continue;
      has_left = true;
      frame.object_if(Claim::suppression_honoured, 0, k + 1, suppression - 1);
    }
    if (!has_left) frame.object(Claim::suppression_honoured);
  }
  // A mark stays as long as one of its descriptors is suppressed.
  const Members suppressed = state.template in_state<C>(s, relation);
  for (unsigned k = frame.count(); k-- > 0;) {
    const Slot slot = frame.slot(k);
    if (!is_mark_of(slot) || (slot.set & suppressed) != 0) continue;
    frame.erase_marks(What::repair_left, slot.set, relation);
    k = std::min(k, frame.count());
  }
}

}  // namespace stormproof::explorer
