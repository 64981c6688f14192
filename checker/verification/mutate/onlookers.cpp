#include "checker/verification/mutate/onlookers.hpp"

#include "model/trace/replay.hpp"
#include "props/laws/law.hpp"

namespace stormproof::mutate {

Onlookers::Onlookers(const model::Scenario& scenario, const Ids& silent) {
  for (const std::string_view id : props::monitored_properties(scenario)) {
    if (id == followed || silent.contains(id)) continue;
    monitors_.push_back(props::make_monitor(id, scenario));
  }
  for (const props::Law& law : props::laws()) {
    const bool speaks = law.watch != nullptr && props::speaks_of(law, scenario);
    if (speaks && !silent.contains(law.id)) monitors_.push_back(law.watch(scenario));
  }
  for (const auto& monitor : monitors_) probes_.add(*monitor);
}

Ids Onlookers::objections(const model::Scenario& scenario, const model::RunResult& result) {
  Ids ids;
  const bool was_cut_off = result.end == model::RunEnd::interrupted;  // nothing is owed yet
  for (const auto& monitor : monitors_) {
    if (!was_cut_off) monitor->finish(model::trace::known_until(result, scenario));
    if (monitor->violation()) ids.insert(monitor->property());
  }
  return ids;
}

}  // namespace stormproof::mutate
