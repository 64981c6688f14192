// Cyclone DDS's rules over solver expressions: one instantiation of the tables per source file.
#include "checker/engines/tables/derive.hpp"
#include "checker/engines/tables/descriptor_system.hpp"
#include "fsm/composition/cyclone.hpp"

namespace stormproof::tables {

void derive_of(model::Of<composition::cyclone::Cyclone>, Derived& derived) {
  derive<composition::cyclone::Cyclone>(derived);
}

}  // namespace stormproof::tables
