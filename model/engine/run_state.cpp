// How the events of a run with a deliberate mistake are scheduled (model/mutation.hpp).
#include "model/engine/run_state.hpp"

#include <algorithm>

namespace stormproof::model {

std::uint32_t RunState::schedule_mutated(Nanoseconds time, EventKind kind, std::uint32_t subject,
                                         std::uint32_t detail) {
  EventClass event_class = class_of(kind);
  std::uint32_t times = 1;
  for (const EventMutation& change : mutation->events) {
    if (change.kind != kind) continue;
    switch (change.change) {
      case EventMutation::Change::forget:
        return 0;
      case EventMutation::Change::shift:
        time += change.by;
        break;
      case EventMutation::Change::duplicate:
        ++times;
        break;
      case EventMutation::Change::reclass:
        event_class = change.event_class;
        break;
    }
  }
  // Whatever the mistake, the clock does not run backwards.
  time = std::max(time, now);
  for (std::uint32_t k = 0; k < times; ++k) {
    const std::uint64_t insertion = queue.schedule_as(event_class, time, kind, subject, detail);
    if (who_hears(Report::scheduled) != nullptr) probe->scheduled(insertion, time, kind, subject);
  }
  return times;
}

}  // namespace stormproof::model
