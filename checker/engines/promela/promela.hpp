// Promela models of one relation, for SPIN: an independent model checker looks at the same
// transition tables. A model composes the writer's table, generated from the reflected rows, with a
// reader (its bitmap X), channels that may lose anything, ACKNACKs whose bitmaps are snapshots, and
// the timers of the relation. It has no clock: whatever is due happens at any time, which covers
// all delays and schedules.
//
// Properties in a model, as LTL claims:
//   safe_d    [] (descriptor d is in A -> X_d): what counts as acknowledged has been received
//   progress  if losses end, all descriptors are in A some time (under weak fairness)
// and an end state in which something is not acknowledged is invalid (a deadlock).
#pragma once

#include <span>
#include <string>

#include "fsm/table_mutation.hpp"

namespace stormproof::promela {

/// Largest number of descriptors; the state space grows by a factor of about 20 with each.
inline constexpr unsigned max_descriptors = 4;
/// Models with more descriptors have no `progress` claim: fairness multiplies the states again.
inline constexpr unsigned max_descriptors_of_progress = 2;

/// The paper's writer (fsm/descriptor_repair.hpp), with both values of `acknowledge`.
/// `descriptors` is 1 … max_descriptors. `mutations` are mistakes in the table, or none.
[[nodiscard]] std::string promela_of_descriptor_repair(
    unsigned descriptors, std::span<const fsm::TableMutation> mutations = {});

/// Fast DDS's writer (fsm/change_for_reader.hpp): some descriptors exist when the reader is
/// matched, the others are created afterwards.
[[nodiscard]] std::string promela_of_change_for_reader(
    unsigned descriptors, std::span<const fsm::TableMutation> mutations = {});

}  // namespace stormproof::promela
