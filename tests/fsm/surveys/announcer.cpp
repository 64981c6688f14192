// Inputs of the announcement schedule: numbers around that of the last startup announcement, and
// none of these.
#include "fsm/announcer.hpp"

#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

MachineSurvey survey_announcer() {
  Inputs<Announcer> inputs;
  for (const std::int64_t number : {0, 1, 2, 3}) {
    for (const std::int64_t startup : {0, 1, 2, 5}) {
      inputs.push_back({7, number, startup, 100, 3'000});
    }
  }
  return survey<Announcer>(inputs);
}

}  // namespace stormproof::fsm
