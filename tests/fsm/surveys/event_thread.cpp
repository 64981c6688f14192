// Inputs of the event thread: copies that take time, and that take none.
#include "fsm/event_thread.hpp"

#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

MachineSurvey survey_event_thread() { return survey<EventThread>({{0, 0}, {5, 0}, {5, 20}}); }

}  // namespace stormproof::fsm
