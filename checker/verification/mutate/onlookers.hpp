// Who judges a run from outside, without executing the rules beside it: every property that a run
// decides but `composition.followed`, and every law that is about one run. A mistake in the rules
// themselves, which all who execute them share, is noticed by nobody else.
#pragma once

#include <memory>
#include <set>
#include <string_view>
#include <vector>

#include "model/mutation.hpp"
#include "model/run_result.hpp"
#include "model/scenario.hpp"
#include "model/trace/probe_list.hpp"
#include "props/monitor.hpp"

namespace stormproof::mutate {

/// Ids of properties and laws.
using Ids = std::set<std::string_view>;

/// It re-executes the correct rules.
inline constexpr std::string_view followed = "composition.followed";

class Onlookers {
 public:
  /// All who have something to say of runs of the scenario, but `silent`.
  explicit Onlookers(const model::Scenario& scenario, const Ids& silent = {});

  /// Somebody else watches the same run; it must outlive this.
  void add(model::Probe& probe) { probes_.add(probe); }
  [[nodiscard]] model::Probe& probe() { return probes_; }
  /// Who objects to the run of the scenario that has ended.
  [[nodiscard]] Ids objections(const model::Scenario& scenario, const model::RunResult& result);

 private:
  std::vector<std::unique_ptr<props::Monitor>> monitors_;
  model::trace::ProbeList probes_;
};

}  // namespace stormproof::mutate
