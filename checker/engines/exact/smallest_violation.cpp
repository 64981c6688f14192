// Tries smaller deployments, each only up to the event at which the best counterexample so far
// ends.
#include "checker/engines/exact/smallest_violation.hpp"

#include <algorithm>

#include "checker/engines/exact/observed_run.hpp"
#include "checker/engines/exact/smaller_deployments.hpp"

namespace stormproof::exact {

namespace {

/// Events of all runs together: the search ends at the same place on every machine.
constexpr std::uint64_t budget = 2'000'000;

}  // namespace

props::Counterexample shortest(const props::Counterexample& found, const model::Scenario& scenario,
                               std::string_view property, const std::function<bool()>& goes_on) {
  std::uint64_t left = budget;
  props::Counterexample best = found;
  model::Scenario family = found.scenario;
  family.deployment.schedule = scenario.deployment.schedule;
  for (const model::Scenario& smaller : smaller_scenarios(family)) {
    if (left == 0 || best.event == 0 || (goes_on && !goes_on())) break;
    const RunPlan plan{smaller, smaller, nullptr, std::min(best.event, left), goes_on};
    const std::string_view wanted[] = {property};
    const ObservedRun run =
        property == quiescence ? run_until_quiet(plan) : run_observed(wanted, plan);
    left -= std::min(left, run.result.events);
    const props::Monitor* const monitor = run.monitor(property);
    if (monitor == nullptr || !monitor->violation()) continue;
    const props::Violation& violation = *monitor->violation();
    if (violation.event >= best.event) continue;
    best.scenario = run.scenario;
    best.event = violation.event;
    best.time = violation.time;
    best.reason = violation.reason;
  }
  return best;
}

}  // namespace stormproof::exact
