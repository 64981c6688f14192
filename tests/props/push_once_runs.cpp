// Apart from the tests, since what is instantiated here would replace the same in the monitors.
#include "tests/props/push_once_runs.hpp"

#include "model/engine/implementation_maker.hpp"
#include "model/simulator.hpp"
#include "props/monitors/auditor.hpp"
#include "props/monitors/auditors.hpp"
#include "tests/model/push_once/push_once_host.hpp"

namespace stormproof::props {

void run_push_once(const model::Scenario& scenario, model::Probe& probe,
                   const model::Mutation* mutation) {
  model::RunOptions options;
  options.max_events = 10'000;
  options.probe = &probe;
  options.mutation = mutation;
  (void)simulate(scenario, options,
                 model::maker_of<model::PushOnceHost>(model::SameHostPairs::left_out));
}

std::unique_ptr<Monitor> watch_push_once(const model::Scenario& scenario) {
  using Rules = fsm::composition::push_once::PushOnce;
  return watch_composition(scenario,
                           [](model::RunState& run, Audit& audit) -> std::unique_ptr<Follower> {
                             return std::make_unique<Auditor<Rules>>(run, audit);
                           });
}

}  // namespace stormproof::props
