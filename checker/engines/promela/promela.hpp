// Promela models of one relation, for SPIN: an independent model checker looks at the same
// transition tables and the same rules between them, written as text by
// checker/engines/promela/promela_of.cpp from the recorded program of any composition. Besides the
// rules a model has channels that may lose anything. It has no clock: whatever is due happens at
// any time, which covers all delays and schedules.
//
// Properties in a model, as LTL claims:
//   safe_d    [] (descriptor d is in A -> X_d): what counts as acknowledged has been received
//   progress  if losses end, all descriptors are in A some time (under weak fairness)
// and an end state in which something is not acknowledged is invalid (a deadlock).
#pragma once

#include <string>

#include "fsm/program/program.hpp"
#include "model/dds_profile.hpp"
#include "model/mutation.hpp"

namespace stormproof::promela {

/// Largest number of descriptors; each multiplies the states by ten or more.
inline constexpr unsigned max_descriptors = 4;
/// Models with more descriptors have no `progress` claim: fairness multiplies the states again.
inline constexpr unsigned max_descriptors_of_progress = 2;

/// A composition with 1 … max_descriptors descriptors, under a profile with the periodic HEARTBEAT
/// policy. `mistakes` are those of tables and effects that a mutant makes, or none; others have no
/// meaning here.
[[nodiscard]] std::string promela_of(const fsm::program::Program& program, unsigned descriptors,
                                     const model::DdsProfile& dds,
                                     const model::Mutation& mistakes = {});

/// That of the profile's implementation.
[[nodiscard]] std::string promela_of(unsigned descriptors, const model::DdsProfile& dds,
                                     const model::Mutation& mistakes = {});

}  // namespace stormproof::promela
