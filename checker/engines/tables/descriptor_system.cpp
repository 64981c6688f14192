// Which of the two systems, and what both assume.
#include "checker/engines/tables/descriptor_system.hpp"

namespace stormproof::tables {

DescriptorSystem descriptor_system(Proof& proof) {
  proof.assume(
      "ACKNACKs may be delayed, lost, duplicated and reordered without bound; DATA may arrive at "
      "any time, even if it was never sent; timers may fire at any time.");
  proof.assume(
      "The number of descriptors is arbitrary: one is looked at, and what its rows read of the "
      "others ranges freely.");
  const bool fastdds = model::is_fastdds(proof.scenario().dds);
  return fastdds ? fastdds_descriptor_system(proof) : paper_descriptor_system(proof);
}

}  // namespace stormproof::tables
