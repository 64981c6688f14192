// The paper's events in two orders: one instantiation of the tables per source file.
#include "checker/engines/tables/event_kinds.hpp"

namespace stormproof::tables {

std::vector<EventGroup> events_of(model::Of<fsm::composition::paper::Paper>) {
  return event_groups<KnownOfPaper>();
}

}  // namespace stormproof::tables
