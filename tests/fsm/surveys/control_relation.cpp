// The two sides of a control-only relation. They have no input: one value is all there is. It is
// listed twice, because a survey takes a single input for a mistake.
#include "fsm/control_relation.hpp"

#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

MachineSurvey survey_control_writer() { return survey<ControlWriter>(Inputs<ControlWriter>(2)); }

MachineSurvey survey_control_reader() { return survey<ControlReader>(Inputs<ControlReader>(2)); }

}  // namespace stormproof::fsm
