// Which scenario runs: what a mutant makes of the specification.
#include "checker/engines/bounds/check_request.hpp"

namespace stormproof::checker {

model::Scenario scenario_to_run(const CheckRequest& request) {
  model::Scenario scenario = request.scenario;
  if (request.mutant != nullptr && request.mutant->knobs) request.mutant->knobs(scenario);
  return scenario;
}

}  // namespace stormproof::checker
