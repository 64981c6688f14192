// Inputs of Fast DDS's view of one descriptor towards one reader: all there are.
#include "fsm/change_for_reader.hpp"

#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

MachineSurvey survey_change_for_reader() {
  return survey<ChangeForReader>({{false, false}, {false, true}, {true, false}, {true, true}});
}

}  // namespace stormproof::fsm
