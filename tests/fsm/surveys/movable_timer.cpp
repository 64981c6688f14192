// Inputs of the timer that moves to earlier times only: before, when and after it is due.
#include "fsm/movable_timer.hpp"

#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

MachineSurvey survey_movable_timer() {
  return survey<MovableTimer>({{5, 7, 6}, {5, 7, 7}, {5, 7, 8}, {7, 7, 9}, {8, 7, 8}});
}

}  // namespace stormproof::fsm
