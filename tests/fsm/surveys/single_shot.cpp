// Inputs of the timer that is pending at most once: delays of 0, too.
#include "fsm/single_shot.hpp"

#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

MachineSurvey survey_single_shot() {
  return survey<SingleShot>({{0, 0}, {0, 10}, {7, 0}, {7, 10}});
}

}  // namespace stormproof::fsm
