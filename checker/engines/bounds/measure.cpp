// One run with a probe that measures delays.
#include "checker/engines/bounds/measure.hpp"

#include "model/simulator.hpp"
#include "props/monitors/delay_probe.hpp"

namespace stormproof::exact {

Measured measure(const model::Scenario& scenario, const checker::CheckRequest& request) {
  model::Scenario run = scenario;
  run.run_until = model::RunUntil::completion;
  props::DelayProbe probe{run};
  model::RunOptions options;
  options.probe = &probe;
  options.on_progress = [&](const model::Progress&) {
    return !request.on_progress || request.on_progress("measuring delays");
  };
  const model::RunResult result = model::simulate(run, options);
  Measured measured;
  measured.largest_delay = probe.delays().largest(result.end_time);
  measured.largest_received_delay = probe.delays().largest_received();
  measured.largest_initial_data_delay = probe.delays().largest_initial_data();
  measured.lost = probe.delays().lost();
  measured.t_disc = result.discovery_time;
  measured.end_time = result.end_time;
  measured.events = result.events;
  measured.initial_data = result.counts.initial_data;
  measured.repair_data = result.counts.repair_data;
  return measured;
}

}  // namespace stormproof::exact
