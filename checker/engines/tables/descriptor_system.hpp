// One generic descriptor of one relation as a transition system: the writer's state C of it, the
// receiver's bit X, and the contents of all ACKNACKs that were ever generated. Each of these may
// arrive any number of times, arbitrarily late, in any order, or never; so whatever the network
// does is one of its runs. All other descriptors enter only through unknowns. That is why a proof
// about it holds for any number of descriptors.
#pragma once

#include "checker/engines/tables/transition_system.hpp"

namespace stormproof::tables {

struct DescriptorSystem {
  TransitionSystem system;  ///< `bad` is left to the property
  Expr acknowledged;        ///< C = A
  Expr received;            ///< X = 1
  Expr unasked_repair;      ///< repair DATA carried it though no ACKNACK that listed it had arrived
};

/// The system of the implementation that the scenario of `proof` names, with the mutant's mistakes.
/// States its assumptions in the finding.
[[nodiscard]] DescriptorSystem descriptor_system(Proof& proof);

/// The paper's writer (fsm/descriptor_repair.hpp).
[[nodiscard]] DescriptorSystem paper_descriptor_system(Proof& proof);
/// Fast DDS's writer (fsm/change_for_reader.hpp).
[[nodiscard]] DescriptorSystem fastdds_descriptor_system(Proof& proof);

}  // namespace stormproof::tables
