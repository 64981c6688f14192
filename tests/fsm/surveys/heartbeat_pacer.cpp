// Inputs of the pace of a Cyclone DDS writer: somebody or nobody waits, and the interval is over,
// not over, longer, or does not count.
#include "fsm/heartbeat_pacer.hpp"

#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

MachineSurvey survey_heartbeat_pacer() {
  const Inputs<HeartbeatPacer>::value_type waiting{.waiting = true,
                                                   .sent_before = true,
                                                   .now = 1'000,
                                                   .last_sent = 900,
                                                   .number = 0,
                                                   .interval = 100,
                                                   .interval_max = 8'000,
                                                   .match_delay = 1};
  Inputs<HeartbeatPacer> inputs(5, waiting);
  inputs[1].waiting = false;
  inputs[2].last_sent = 901;
  inputs[3].number = 7;
  inputs[4].last_sent = 999;
  inputs[4].sent_before = false;
  return survey<HeartbeatPacer>(inputs);
}

}  // namespace stormproof::fsm
