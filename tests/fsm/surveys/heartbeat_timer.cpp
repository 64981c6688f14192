// Inputs of the HEARTBEAT timer under both policies, with the instants at which a response comes
// just in time and just too late.
#include "fsm/heartbeat_timer.hpp"

#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

namespace {

using Input = Flyweight<HeartbeatTimer>::Input;

Input periodic(bool additive, bool unacknowledged, std::int64_t pending) {
  return {.now = 500,
          .heartbeat_period = 1'000,
          .adaptive = false,
          .additive = additive,
          .pending = pending,
          .unacknowledged = unacknowledged,
          .cycle = {}};
}

/// A cycle that started at 1,000 with T = 200 and contacted two readers; bounds 100 and 3,000.
Input adaptive(std::int64_t now, std::int64_t responded, bool unacknowledged) {
  return {.now = now,
          .heartbeat_period = 1'000,
          .adaptive = true,
          .additive = false,
          .pending = 0,
          .unacknowledged = unacknowledged,
          .cycle = {.start = 1'000,
                    .period = 200,
                    .contacted = 2,
                    .responded = responded,
                    .min_period = 100,
                    .max_period = 3'000}};
}

}  // namespace

MachineSurvey survey_heartbeat_timer() {
  Inputs<HeartbeatTimer> inputs;
  for (const bool unacknowledged : {false, true}) {
    for (const bool additive : {false, true}) {
      for (const std::int64_t pending : {0, 1, 2}) {
        inputs.push_back(periodic(additive, unacknowledged, pending));
      }
    }
    for (const std::int64_t now : {1'000, 1'050, 1'199, 1'200, 1'201}) {
      for (const std::int64_t responded : {0, 1, 2}) {
        inputs.push_back(adaptive(now, responded, unacknowledged));
      }
    }
  }
  return survey<HeartbeatTimer>(inputs);
}

}  // namespace stormproof::fsm
