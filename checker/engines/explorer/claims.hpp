// What the explorer objects to, whatever the implementation: that a repair was asked for, that an
// ACKNACK arrives as it was emitted, copies and repairs without a loss, the suppression of what has
// been repaired, and what is acknowledged. Stalls, completion and silence are the search's own
// (checker/engines/explorer/search.hpp).
#pragma once

#include <optional>

#include "checker/engines/explorer/frame.hpp"
#include "checker/engines/explorer/world_state.hpp"

namespace stormproof::explorer {

/// `members` are generated for a reader, in answer to an ACKNACK if it is a repair; `asked` have
/// been listed by one since they were generated last, `generated` have been before.
void object_to_generated(Frame& frame, Members members, bool is_repair, Members asked,
                         Members generated);

/// An ACKNACK is emitted whose reader lacks what is not in X. `announced`: those that it has heard
/// of, if it lists no others, and its base is the first that it lacks; then an initial ACKNACK
/// claims nothing.
void object_to_listed(Frame& frame, const Slot& acknack, Members received, unsigned descriptors,
                      std::optional<Members> announced);

/// The writer takes `listed` from an ACKNACK of its reader, which has been emitted as `emitted`.
void object_to_taken(Frame& frame, Members listed, const Slot& emitted);

/// The reader, which has received some, is about to take `carried`.
void object_to_copies(Frame& frame, Members carried, Members received);

/// The suppression of these begins, towards the relation's reader.
void mark_left(Frame& frame, unsigned relation, Members members);

/// The writer's view of a relation's descriptors.
struct View {
  Members unacknowledged = 0;  ///< in U
  Members suppressed = 0;      ///< in S
  Members acknowledged = 0;    ///< in A
};
/// What must hold of the descriptors of a relation after each event; they have to be suppressed
/// for `suppression` ns.
void check_descriptors(const View& before, const View& now, Members received, Frame& frame,
                       unsigned relation, std::int64_t suppression);

}  // namespace stormproof::explorer
