// What the explorer objects to, whatever the implementation: that a repair was asked for, that an
// ACKNACK arrives as it was emitted, copies and repairs without a loss, the suppression of what has
// been repaired, and what is acknowledged. Stalls, completion and silence are the search's own
// (checker/engines/explorer/search.hpp).
#pragma once

#include <algorithm>
#include <bit>
#include <string_view>

#include "checker/engines/explorer/frame.hpp"
#include "checker/engines/explorer/world_state.hpp"
#include "fsm/reflect.hpp"

namespace stormproof::explorer {

/// These descriptors are generated for the reader, in answer to an ACKNACK if it is a repair.
template <class State>
void note_generated(State& state, Frame& frame, unsigned reader, Members members, bool repair) {
  frame.count_generated(static_cast<unsigned>(std::popcount(members)));
  const Members asked = state.template get<Asked>(reader);
  const Members generated = state.template get<Generated>(reader);
  if (repair && (members & ~asked) != 0) frame.object(Claim::repair_only_if_asked);
  if (frame.no_losses_yet() && (members & generated) != 0) frame.object(Claim::free_threshold);
  state.template set<Generated>(generated | members, reader);
  state.template set<Asked>(asked & static_cast<Members>(~members), reader);
}

/// The writer takes an ACKNACK of the reader that lists these; `as_emitted`: it is what was
/// emitted.
template <class State>
void note_asked(State& state, Frame& frame, unsigned reader, Members listed, bool as_emitted) {
  if (!as_emitted) frame.object(Claim::snapshot);
  state.template set<Asked>(state.template get<Asked>(reader) | listed, reader);
}

/// The reader is about to take these.
template <class State>
void note_copies(const State& state, Frame& frame, unsigned reader, Members carried) {
  const bool again = (carried & state.template get<comp::X>(reader)) != 0;
  if (again && frame.no_losses_yet()) frame.object(Claim::single_copy);
}

/// The suppression of these begins, towards the reader.
inline void note_left(Frame& frame, unsigned reader, Members members) {
  frame.erase_marks(What::repair_left, members, reader);
  frame.mark({What::repair_left, 0, members, 0, static_cast<std::uint8_t>(reader)});
}

/// What must hold of the descriptors towards a reader after each event; they have to be suppressed
/// for `suppression` ns. `C` is the writer's view of them.
template <class C, class State>
void check_descriptors(const State& before, const State& state, Frame& frame, unsigned reader,
                       std::int64_t suppression) {
  // By the paper's letters.
  constexpr auto letter = [](std::string_view name) {
    const auto& names = fsm::Reflect<typename C::Machine>::state_names;
    return static_cast<fsm::StateId>(std::ranges::find(names, name) - names.begin());
  };
  constexpr fsm::StateId u = letter("U");
  constexpr fsm::StateId s = letter("S");
  constexpr fsm::StateId a = letter("A");
  if ((state.template in_state<C>(a, reader) & ~state.template get<comp::X>(reader)) != 0) {
    frame.object(Claim::ack_implies_received);
  }
  const unsigned returned =
      before.template in_state<C>(s, reader) & state.template in_state<C>(u, reader);
  const auto is_mark_of = [reader](const Slot& slot) {
    return slot.what == What::repair_left && slot.reader == reader;
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
  const Members suppressed = state.template in_state<C>(s, reader);
  for (unsigned k = frame.count(); k-- > 0;) {
    const Slot slot = frame.slot(k);
    if (!is_mark_of(slot) || (slot.set & suppressed) != 0) continue;
    frame.erase_marks(What::repair_left, slot.set, reader);
    k = std::min(k, frame.count());
  }
}

}  // namespace stormproof::explorer
