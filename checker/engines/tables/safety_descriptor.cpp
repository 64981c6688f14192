// safety.ack-implies-received: what a writer takes as acknowledged, its reader has.
// safety.repair-only-if-asked: repair DATA carries only descriptors that an ACKNACK listed.
// Both are about one generic descriptor (checker/engines/tables/descriptor_system.hpp).
#include "checker/engines/tables/descriptor_system.hpp"
#include "checker/engines/tables/properties.hpp"

namespace stormproof::tables {

Finding safety_ack_implies_received(const CheckRequest& request) {
  Proof proof{"safety.ack-implies-received", request};
  DescriptorSystem descriptor = descriptor_system(proof);
  descriptor.system.bad = descriptor.acknowledged && !descriptor.received;
  return proof.finish(prove_unreachable(proof, descriptor.system,
                                        "a descriptor is in A that the reader has not received"));
}

Finding safety_repair_only_if_asked(const CheckRequest& request) {
  Proof proof{"safety.repair-only-if-asked", request};
  DescriptorSystem descriptor = descriptor_system(proof);
  descriptor.system.bad = descriptor.unasked_repair;
  if (model::is_fastdds(proof.scenario().dds)) {
    proof.assume("DATA that is pushed when its descriptor is created is no repair.");
  }
  return proof.finish(prove_unreachable(proof, descriptor.system,
                                        "repair DATA carries a descriptor that nobody asked for"));
}

}  // namespace stormproof::tables
