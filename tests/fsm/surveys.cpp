// The list of the machines' surveys.
#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

std::vector<MachineSurvey> all_surveys() {
  std::vector<MachineSurvey> surveys;
  surveys.push_back(survey_descriptor_repair());
  surveys.push_back(survey_discovery_reader());
  surveys.push_back(survey_heartbeat_timer());
  surveys.push_back(survey_initial_acknack());
  surveys.push_back(survey_announcer());
  surveys.push_back(survey_channel());
  surveys.push_back(survey_change_for_reader());
  surveys.push_back(survey_single_shot());
  surveys.push_back(survey_control_writer());
  surveys.push_back(survey_control_reader());
  return surveys;
}

}  // namespace stormproof::fsm
