// Compositions are listed in the order of implementations.
#include "model/composition_of.hpp"

#include "fsm/composition/compositions.hpp"
#include "model/implementations.hpp"

namespace stormproof::model {

const fsm::composition::CompositionInfo& composition_of(ImplementationKind kind) {
  return fsm::composition::compositions()[composition_index(kind)];
}

const fsm::composition::CompositionInfo& composition_of(const DdsProfile& dds) {
  return composition_of(kind_of(dds));
}

}  // namespace stormproof::model
