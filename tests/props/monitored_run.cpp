// Runs with all monitors.
#include "tests/props/monitored_run.hpp"

#include <cstdio>
#include <cstdlib>

#include "model/config/scenario_file.hpp"
#include "model/implementations.hpp"
#include "model/trace/probe_list.hpp"
#include "props/applicability.hpp"

namespace stormproof::props {

const Violation* MonitoredRun::violation(std::string_view property) const {
  for (const auto& monitor : monitors) {
    if (monitor->property() == property && monitor->violation()) return &*monitor->violation();
  }
  return nullptr;
}

std::string MonitoredRun::violated() const {
  std::string list;
  for (const auto& monitor : monitors) {
    if (!monitor->violation()) continue;
    if (!list.empty()) list += ' ';
    list += monitor->property();
  }
  return list;
}

std::string MonitoredRun::remarks(std::string_view property) const {
  std::string text;
  for (const auto& monitor : monitors) {
    if (monitor->property() != property) continue;
    for (const std::string& line : monitor->remarks()) text += line + '\n';
  }
  return text;
}

MonitoredRun run_monitored(const model::Scenario& scenario, const model::Scenario& specification,
                           model::RunOptions options) {
  MonitoredRun run;
  model::trace::ProbeList probes;
  for (const std::string_view property : monitored_properties()) {
    const auto kind = model::kind_of(specification.dds);
    // Otherwise its monitors know no such writer.
    if (!applicability_of(*find_property(property), kind).applies()) continue;
    run.monitors.push_back(make_monitor(property, specification));
    probes.add(*run.monitors.back());
  }
  options.probe = &probes;
  run.result = model::simulate(scenario, options);
  const bool open_end = run.result.end == model::RunEnd::time_limit ||
                        run.result.end == model::RunEnd::no_more_events;
  for (const auto& monitor : run.monitors) {
    monitor->finish(open_end ? scenario.time_limit : run.result.end_time);
  }
  return run;
}

model::Scenario shipped(const std::string& name, const std::vector<std::string>& overrides) {
  const auto scenario =
      model::config::read_scenario(name, overrides, model::config::SpecPath::standard());
  if (!scenario) {
    std::fprintf(stderr, "%s: no such scenario or override\n", name.c_str());
    std::abort();
  }
  return *scenario;
}

}  // namespace stormproof::props
