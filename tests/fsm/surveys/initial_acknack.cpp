// Inputs of the timer of the initial ACKNACK: a delay of 0, and both kinds of intervals.
#include "fsm/initial_acknack.hpp"

#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

MachineSurvey survey_initial_acknack() {
  Inputs<InitialAckNack> inputs;
  for (const std::int64_t now : {0, 5}) {
    for (const std::int64_t first : {0, 1, 70}) {
      for (const bool seen : {false, true}) {
        for (const std::int64_t factor : {1, 2, 4}) {
          for (const bool constant : {false, true}) {
            inputs.push_back({now, first, first * factor, seen, constant});
          }
        }
      }
    }
  }
  return survey<InitialAckNack>(inputs);
}

}  // namespace stormproof::fsm
