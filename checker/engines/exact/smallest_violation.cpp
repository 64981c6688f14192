// Tries smaller deployments, each only up to the event at which the best counterexample so far
// ends.
#include "checker/engines/exact/smallest_violation.hpp"

#include <chrono>

#include "checker/engines/exact/observed_run.hpp"
#include "checker/engines/exact/smaller_deployments.hpp"

namespace stormproof::exact {

namespace {

constexpr std::chrono::milliseconds budget{1000};

}  // namespace

props::Counterexample shortest(const props::Counterexample& found, const model::Scenario& scenario,
                               std::string_view property, const std::function<bool()>& goes_on) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end = Clock::now() + budget;
  const auto in_time = [&] { return Clock::now() < end && (!goes_on || goes_on()); };
  props::Counterexample best = found;
  model::Scenario family = found.scenario;
  family.deployment.schedule = scenario.deployment.schedule;
  for (const model::Scenario& smaller : smaller_scenarios(family)) {
    if (!in_time() || best.event == 0) break;
    const RunPlan plan{smaller, smaller, nullptr, best.event, in_time};
    const std::string_view wanted[] = {property};
    const ObservedRun run =
        property == quiescence ? run_until_quiet(plan) : run_observed(wanted, plan);
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
