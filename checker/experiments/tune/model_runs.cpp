// A run is cut short by its time limit alone; the monitors then know of the part that was run. What
// would break later than the limit of the search is seen in the final comparison, which runs
// without it.
#include "checker/experiments/tune/model_runs.hpp"

#include <algorithm>

#include "checker/engines/exact/observed_run.hpp"
#include "model/implementations.hpp"
#include "model/reference.hpp"
#include "props/limits.hpp"

namespace stormproof::tune {

using model::Nanoseconds;
using model::Scenario;

namespace {

double missing_share(const Scenario& scenario, const model::RunResult& result) {
  const auto required = static_cast<double>(model::failure_free_reference(scenario).initial_data);
  return required > 0 ? static_cast<double>(result.missing_count) / required : 0;
}

}  // namespace

std::optional<Outcome> run_once(const Scenario& scenario, std::span<const std::string_view> ids,
                                Nanoseconds limit, const std::function<bool()>& goes_on) {
  Scenario cut = scenario;
  cut.time_limit = std::min(scenario.time_limit, limit);
  cut.run_until = model::RunUntil::completion;
  std::vector<std::string_view> ordinary{ids.begin(), ids.end()};
  const bool quiet_too = std::erase(ordinary, exact::quiescence) > 0;
  const exact::RunPlan plan{cut, scenario, nullptr, 0, goes_on};
  const exact::ObservedRun run = exact::run_observed(ordinary, plan);
  if (run.result.end == model::RunEnd::interrupted) return std::nullopt;
  Outcome outcome;
  outcome.completion = run.result.discovery_time;
  outcome.counts = run.result.counts;
  outcome.health = exact::health_of(cut, run.result);
  if (!outcome.completion) outcome.missing = missing_share(scenario, run.result);
  for (const auto& monitor : run.monitors) {
    if (monitor->violation()) outcome.broken.push_back(monitor->property());
  }
  if (!outcome.completion && limit < scenario.time_limit) outcome.cut = limit;
  if (quiet_too && !outcome.cut) {
    const exact::RunPlan long_plan{scenario, scenario, nullptr, 0, goes_on};
    const exact::ObservedRun quiet = exact::run_until_quiet(long_plan);
    if (goes_on && !goes_on()) return std::nullopt;
    if (quiet.monitors.front()->violation()) outcome.broken.push_back(exact::quiescence);
  }
  std::ranges::sort(outcome.broken);
  return outcome;
}

std::vector<std::string_view> watchable(const Scenario& scenario) {
  std::vector<std::string_view> ids = exact::ordinary_properties(scenario);
  for (const std::string_view id : props::set_limits(scenario.limits)) ids.push_back(id);
  return ids;
}

}  // namespace stormproof::tune
