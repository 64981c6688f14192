// Compositions are listed in the order of implementations.
#include "model/composition_of.hpp"

#include "fsm/composition/compositions.hpp"

namespace stormproof::model {

const fsm::composition::CompositionInfo& composition_of(ImplementationKind kind) {
  return fsm::composition::compositions()[static_cast<std::size_t>(kind)];
}

const fsm::composition::CompositionInfo& composition_of(const DdsProfile& dds) {
  return composition_of(dds.implementation);
}

}  // namespace stormproof::model
