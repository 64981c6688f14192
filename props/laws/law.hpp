// Laws: statements about every run, or about how two runs of related scenarios compare, that follow
// from the rules without looking at how they are implemented. A law is tried on random scenarios by
// the tests and by `stormproof mutate`; a user's scenario can be held against them, too.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "model/probe.hpp"
#include "model/run_result.hpp"
#include "model/scenario.hpp"
#include "props/monitor.hpp"

namespace stormproof::props {

/// Runs a scenario under an optional observer. A test passes `model::simulate`, `mutate` the same
/// with a mistake.
using Simulate = std::function<model::RunResult(const model::Scenario&, model::Probe*)>;

struct Law {
  std::string_view id;         ///< "law.time-scaling"; stable
  std::string_view statement;  ///< one line
  /// Whether the law says something about the scenario.
  bool (*applies)(const model::Scenario&);
  /// What breaks the law, in one sentence with numbers, or nothing. The scenario must be one that
  /// it applies to.
  std::optional<std::string> (*broken)(const model::Scenario&, const Simulate&);
  /// Of a law about one run of the scenario as it is: who watches it, and may as well watch a run
  /// that others watch, too. Null of others. It must not outlive the scenario.
  std::unique_ptr<Monitor> (*watch)(const model::Scenario&) = nullptr;
};

/// All laws.
[[nodiscard]] std::span<const Law> laws();

/// Whether the law says something about the scenario, whatever writers it has: most laws are about
/// those of the paper and of Fast DDS, not about a Discovery Server.
[[nodiscard]] bool speaks_of(const Law& law, const model::Scenario& scenario);

}  // namespace stormproof::props
