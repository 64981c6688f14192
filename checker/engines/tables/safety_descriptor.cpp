// safety.ack-implies-received: what a writer takes as acknowledged, its reader has.
// safety.repair-only-if-asked: repair DATA carries only descriptors that an ACKNACK listed.
// safety.snapshot: an ACKNACK's bitmap never changes after generation: what one generic ACKNACK
// says of the descriptor while it is on its way, against what it said when it was generated. All
// are about one generic descriptor (checker/engines/tables/descriptor_system.hpp).
#include "checker/engines/tables/descriptor_system.hpp"
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
  return proof.finish(prove_unreachable(proof,
                                        descriptor.with_bad(descriptor[watched::unasked_repair]),
                                        "repair DATA carries a descriptor that nobody asked for"));
}

Finding safety_snapshot(const CheckRequest& request) {
  Proof proof{"safety.snapshot", request};
  proof.assume(
      "A packet is a value: after its generation nothing writes to its bitmap, unless the "
      "rules themselves say so.");
  const DescriptorSystem descriptor = descriptor_system(proof);
  const Expr changed = descriptor[watched::lists] != descriptor[watched::listed_at_first];
  return proof.finish(
      prove_unreachable(proof, descriptor.with_bad(descriptor[watched::generated] && changed),
                        "the bitmap of an ACKNACK has changed on its way"));
}

}  // namespace stormproof::tables
