// The paper's rules over solver expressions: one instantiation of the tables per source file.
#include "checker/engines/tables/derive.hpp"
#include "checker/engines/tables/descriptor_system.hpp"

namespace stormproof::tables {

void derive_of(model::Of<composition::paper::Paper>, Derived& derived) {
  derive<composition::paper::Paper>(derived);
}

}  // namespace stormproof::tables
