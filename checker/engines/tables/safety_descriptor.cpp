// safety.ack-implies-received: what a writer takes as acknowledged, its reader has.
// safety.repair-only-if-asked: repair DATA carries only descriptors that an ACKNACK listed since
// DATA with them was made last. safety.snapshot: an ACKNACK lists what its reader lacks when it is
// generated, and its bitmap never changes after that: what one generic ACKNACK says of the
// descriptor while it is on its way, against what it said when it was generated. All are about one
// generic descriptor (checker/engines/tables/descriptor_system.hpp).
#include "checker/engines/tables/properties.hpp"
#include "checker/engines/tables/safety_certificate.hpp"
#include "model/implementations.hpp"

namespace stormproof::tables {

Finding safety_ack_implies_received(const CheckRequest& request) {
  Proof proof{"safety.ack-implies-received", request};
  const DescriptorSystem descriptor = descriptor_system(proof);
  if (descriptor.number()) {
    proof.assume(
        "A reader acknowledges all samples up to a number. A new one counts as having what exists "
        "when it is matched, and nothing is said of it until it has replied.");
  }
  return proof.finish(prove_never(proof, descriptor, acknowledged_is_received(descriptor)));
}

Finding safety_repair_only_if_asked(const CheckRequest& request) {
  Proof proof{"safety.repair-only-if-asked", request};
  const DescriptorSystem descriptor = descriptor_system(proof);
  if (model::traits_of(proof.scenario().dds).creates_endpoints_over_time) {
    proof.assume("DATA that is pushed when its descriptor is created is no repair.");
  }
  proof.assume("What is sent without being asked for is sent once, before anything asks for it.");
  const Expr& asked = descriptor[watched::asked];
  const Expr& bad = descriptor[watched::unasked_repair];
  std::vector<Clause> invariant{
      {"what is requested has been asked for", !descriptor["C=R"] || asked},
      {"no repair is made that nobody asked for", !bad}};
  if (!model::traits_of(proof.scenario().dds).waits_for_source) {
    // The paper's Q comes after the repair has been made.
    invariant.push_back({"what is queued has been asked for", !descriptor["C=Q"] || asked});
  }
  return proof.finish(
      prove_never(proof, descriptor,
                  {std::move(invariant),
                   {},
                   {{bad, "repair DATA carries a descriptor that nobody asked for"}}}));
}

Finding safety_snapshot(const CheckRequest& request) {
  Proof proof{"safety.snapshot", request};
  proof.assume(
      "A packet is a value: after its generation nothing writes to its bitmap, unless the "
      "rules themselves say so.");
  const DescriptorSystem descriptor = descriptor_system(proof);
  const Expr& wrong = descriptor[watched::wrong_list];
  const Expr changed = descriptor[watched::generated] &&
                       descriptor[watched::lists] != descriptor[watched::listed_at_first];
  return proof.finish(
      prove_never(proof, descriptor,
                  {{{"an ACKNACK lists what its reader lacks", !wrong},
                    {"an ACKNACK on its way says what it said at first", !changed}},
                   {},
                   {{wrong, "an ACKNACK does not list what its reader lacks"},
                    {changed, "the bitmap of an ACKNACK has changed on its way"}}}));
}

}  // namespace stormproof::tables
