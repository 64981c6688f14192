// Inputs of the reader of one relation: from nothing to much is missing.
#include "fsm/discovery_reader.hpp"

#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

MachineSurvey survey_discovery_reader() {
  Inputs<DiscoveryReader> inputs;
  for (const bool accepts : {false, true}) {
    for (const std::int64_t missing : {0, 1, 2, 100'000}) inputs.push_back({accepts, missing});
  }
  return survey<DiscoveryReader>(inputs);
}

}  // namespace stormproof::fsm
