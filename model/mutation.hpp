// A deliberate mistake in the rules, for `stormproof mutate`: what the simulator does differently
// in a run. A correct run has none. Mistakes in the transition tables are the tables' own
// (fsm/table_mutation.hpp); here are those in the rules around them: an event that is forgotten,
// comes a nanosecond late, twice or in the wrong class, and an ACKNACK whose bitmap is not a
// snapshot.
#pragma once

#include <vector>

#include "fsm/composition/effect_mutation.hpp"
#include "fsm/table_mutation.hpp"
#include "model/event.hpp"
#include "model/units.hpp"

namespace stormproof::model {

/// Changes how events of one kind are scheduled.
struct EventMutation {
  enum class Change : std::uint8_t {
    forget,     ///< the event is not scheduled
    shift,      ///< it is scheduled `by` later
    duplicate,  ///< it is scheduled twice
    reclass     ///< it is scheduled with `event_class`
  };
  EventKind kind{};
  Change change{};
  Nanoseconds by{};
  EventClass event_class{};
};

struct Mutation {
  std::vector<fsm::TableMutation> tables;
  std::vector<EventMutation> events;
  /// What happens between the machines.
  std::vector<fsm::composition::EffectMutation> effects;
  /// An ACKNACK that arrives asks for what is missing at its arrival, not at its generation.
  bool live_bitmaps = false;
};

}  // namespace stormproof::model
