// Fast DDS's rules over solver expressions: one instantiation of the tables per source file.
#include "checker/engines/tables/derive.hpp"
#include "checker/engines/tables/descriptor_system.hpp"

namespace stormproof::tables {

void derive_of(model::Of<composition::fastdds::FastDds>, Derived& derived) {
  derive<composition::fastdds::FastDds>(derived);
}

/// What clients tell a Discovery Server: the same exchange, whoever opens its relations. What the
/// server relays is not derived.
void derive_of(model::Of<composition::server::FastDdsServer>, Derived& derived) {
  derive<composition::fastdds::FastDds>(derived);
}

}  // namespace stormproof::tables
