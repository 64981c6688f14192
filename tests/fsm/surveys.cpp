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
  surveys.push_back(survey_cautious_reader());
  surveys.push_back(survey_matched_reader());
  surveys.push_back(survey_heartbeat_pacer());
  surveys.push_back(survey_event_thread());
  surveys.push_back(survey_movable_timer());
  surveys.push_back(survey_reopening_repair());
  return surveys;
}

}  // namespace stormproof::fsm
