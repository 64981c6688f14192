// Fast DDS's rules as Promela: one instantiation of the tables per source file.
#include "checker/engines/promela/promela.hpp"
#include "checker/engines/promela/promela_of.hpp"

namespace stormproof::promela {

std::string promela_of_fastdds(unsigned descriptors, const model::DdsProfile& dds,
                               const model::Mutation& mistakes) {
  return promela_of<composition::fastdds::FastDds>(descriptors, dds, mistakes);
}

}  // namespace stormproof::promela
