// The amended rules over solver expressions: one instantiation of the tables per source file.
#include "checker/engines/tables/derive.hpp"
#include "checker/engines/tables/descriptor_system.hpp"
#include "fsm/composition/amended.hpp"

namespace stormproof::tables {

void derive_of(model::Of<composition::amended::Amended>, Derived& derived) {
  derive<composition::amended::Amended>(derived);
}

}  // namespace stormproof::tables
