// safety.ack-implies-received: what a writer takes as acknowledged, its reader has.
// safety.repair-only-if-asked: repair DATA carries only descriptors that an ACKNACK listed since
// DATA with them was made last. safety.snapshot: an ACKNACK lists what its reader lacks when it is
// generated, and its bitmap never changes after that: what one generic ACKNACK says of the
// descriptor while it is on its way, against what it said when it was generated. All are about one
// generic descriptor (checker/engines/tables/descriptor_system.hpp).
#include "checker/engines/tables/descriptor_system.hpp"
#include "checker/engines/tables/houdini.hpp"
#include "checker/engines/tables/properties.hpp"

namespace stormproof::tables {

Finding safety_ack_implies_received(const CheckRequest& request) {
  Proof proof{"safety.ack-implies-received", request};
  const DescriptorSystem descriptor = descriptor_system(proof);
  return proof.finish(prove_unreachable(proof,
                                        descriptor.with_bad(descriptor["C=A"] && !descriptor["X"]),
                                        "a descriptor is in A that the reader has not received"));
}

Finding safety_repair_only_if_asked(const CheckRequest& request) {
  Proof proof{"safety.repair-only-if-asked", request};
  const DescriptorSystem descriptor = descriptor_system(proof);
  if (model::traits_of(proof.scenario().dds).creates_endpoints_over_time) {
    proof.assume("DATA that is pushed when its descriptor is created is no repair.");
  }
  proof.assume("What is sent without being asked for is sent once, before anything asks for it.");
  const Expr& bad = descriptor[watched::unasked_repair];
  const TransitionSystem system = descriptor.with_bad(bad);
  // What is requested, and what is queued because of it, has been asked for. Whoever looks for an
  // invariant without being told may look for long.
  const Expr& asked = descriptor[watched::asked];
  Exprs candidates = facts_of(system);
  const std::size_t told = candidates.size();
  for (const char* state : {"C=R", "C=Q"}) {
    candidates.push_back(!descriptor[state] || asked);
  }
  candidates.push_back(!bad);
  const std::vector<bool> kept = inductive_together(proof, system, candidates);
  if (!kept.back()) {
    return proof.finish(
        prove_unreachable(proof, system, "repair DATA carries a descriptor that nobody asked for"));
  }
  proof.detail("invariant:");
  for (std::size_t k = told; k < candidates.size(); ++k) {
    if (!kept[k]) continue;
    for (const std::string& line : invariant_lines(candidates[k])) proof.detail("  " + line);
  }
  return proof.finish(
      "an invariant that is expected, any number of steps (initially, at each step, at the end)");
}

Finding safety_snapshot(const CheckRequest& request) {
  Proof proof{"safety.snapshot", request};
  proof.assume(
      "A packet is a value: after its generation nothing writes to its bitmap, unless the "
      "rules themselves say so.");
  const DescriptorSystem descriptor = descriptor_system(proof);
  const Expr changed = descriptor[watched::generated] &&
                       descriptor[watched::lists] != descriptor[watched::listed_at_first];
  std::string how = prove_unreachable(proof, descriptor.with_bad(descriptor[watched::wrong_list]),
                                      "an ACKNACK does not list what its reader lacks");
  if (!proof.violated()) {
    how = prove_unreachable(proof, descriptor.with_bad(changed),
                            "the bitmap of an ACKNACK has changed on its way");
  }
  return proof.finish(how);
}

}  // namespace stormproof::tables
