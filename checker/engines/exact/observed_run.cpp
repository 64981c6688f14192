// Runs with monitors. How long a run must go on for live.quiescence depends on the largest delay in
// it, so the monitor is asked while it runs. Attempts of a reader that go on for ever come ever
// more rarely, each after twice the time of the one before: the run has to last twice as long as
// the bound to show one that comes too late. If their distance is constant, one distance longer is
// enough.
#include "checker/engines/exact/observed_run.hpp"

#include <algorithm>

#include "model/simulator.hpp"
#include "model/trace/probe_list.hpp"
#include "props/monitors/quiescence.hpp"

namespace stormproof::exact {

using model::Nanoseconds;
using model::RunEnd;

namespace {

void run_with(ObservedRun& run, const RunPlan& plan) {
  model::trace::ProbeList probes;
  for (const auto& monitor : run.monitors) probes.add(*monitor);
  model::RunOptions options;
  options.probe = probes.empty() ? nullptr : &probes;
  options.mutation = plan.mutation;
  options.max_events = plan.max_events;
  // An instant without end would be the last one.
  const props::Monitor* const progress = run.monitor("timer.progress");
  options.on_progress = [&](const model::Progress&) {
    if (progress != nullptr && progress->violation()) return false;
    return !plan.goes_on || plan.goes_on();
  };
  run.result = model::simulate(run.scenario, options);
  const bool whole =
      run.result.end == RunEnd::time_limit || run.result.end == RunEnd::no_more_events;
  run.known_until = whole ? run.scenario.time_limit : run.result.end_time;
  for (const auto& monitor : run.monitors) monitor->finish(run.known_until);
}

}  // namespace

const props::Monitor* ObservedRun::monitor(std::string_view property) const {
  const auto found = std::ranges::find_if(
      monitors, [&](const auto& monitor) { return monitor->property() == property; });
  return found == monitors.end() ? nullptr : found->get();
}

ObservedRun run_observed(std::span<const std::string_view> properties, const RunPlan& plan) {
  ObservedRun run;
  run.scenario = plan.scenario;
  for (const std::string_view property : properties) {
    auto monitor = props::make_monitor(property, plan.specification);
    if (monitor) run.monitors.push_back(std::move(monitor));
  }
  run_with(run, plan);
  return run;
}

std::vector<std::string_view> ordinary_properties(const model::Scenario& scenario) {
  std::vector<std::string_view> ids = props::monitored_properties(scenario);
  std::erase(ids, quiescence);
  return ids;
}

ObservedRun run_until_quiet(const RunPlan& plan) {
  constexpr std::uint64_t enough_events = 10'000'000;
  constexpr Nanoseconds far_away{1'000'000'000'000'000};
  ObservedRun run;
  run.scenario = plan.scenario;
  run.scenario.run_until = model::RunUntil::time_limit;
  run.scenario.time_limit = far_away;
  auto monitor = props::make_quiescence_monitor(plan.specification);
  bool stopped = false;
  model::RunOptions options;
  options.probe = monitor.get();
  options.mutation = plan.mutation;
  options.max_events = plan.max_events > 0 ? plan.max_events : enough_events;
  options.on_progress = [&](const model::Progress& progress) {
    stopped = plan.goes_on && !plan.goes_on();
    const auto silent = monitor->silent_from(progress.now);
    if (!silent) return !stopped && progress.now <= plan.scenario.time_limit;
    const model::SedpProfile& sedp = plan.specification.dds.sedp;
    const bool doubling = sedp.initial_acknack_interval == model::InitialAckNackInterval::doubling;
    const Nanoseconds next = *silent + sedp.initial_acknack_delay;
    return !stopped && progress.now <= next * (doubling ? 2 : 1);
  };
  run.result = model::simulate(run.scenario, options);
  run.known_until = run.result.end_time;
  run.scenario.time_limit = run.known_until;  // so that the run ends there when it is repeated
  monitor->finish(run.known_until);
  const bool whole = !stopped && run.result.events < options.max_events;
  if (whole) run.result.end = RunEnd::time_limit;
  const auto& discovered = run.result.discovery_time;
  if (discovered && *discovered > plan.scenario.time_limit) run.result.discovery_time.reset();
  run.monitors.push_back(std::move(monitor));
  return run;
}

}  // namespace stormproof::exact
