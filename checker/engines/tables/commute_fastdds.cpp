// Fast DDS's events in two orders: one instantiation of the tables per source file.
#include "checker/engines/tables/event_kinds.hpp"

namespace stormproof::tables {

std::vector<EventGroup> events_of(model::Of<fsm::composition::fastdds::FastDds>) {
  return event_groups<KnownOfFastDds>();
}

}  // namespace stormproof::tables
