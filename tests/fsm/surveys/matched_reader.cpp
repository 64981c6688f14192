// Inputs of a reader as its writer sees it: all there are.
#include "fsm/matched_reader.hpp"

#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

MachineSurvey survey_matched_reader() {
  return survey<MatchedReader>({{false, false}, {false, true}, {true, false}, {true, true}});
}

}  // namespace stormproof::fsm
