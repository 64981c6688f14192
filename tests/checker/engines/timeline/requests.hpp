// Check requests for tests.
#pragma once

#include "checker/engines/smt/claims.hpp"
#include "checker/engines/timeline/timeline.hpp"

namespace stormproof::timeline {

/// One solver, no exports.
inline smt::Options z3_only() {
  smt::Options options;
  options.second_solver = false;
  return options;
}

/// Two hosts with one participant each, a constant delay of 1 ms.
inline model::Scenario quiet_scenario() {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(2, 1, 2);
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = model::Nanoseconds{1'000'000};
  return scenario;
}

/// What the engine says about one property.
inline props::Finding finding_about(std::string_view property, const model::Scenario& scenario,
                                    const checker::Mutant* mutant = nullptr,
                                    smt::Options options = z3_only()) {
  smt::Claims claims{std::move(options)};
  const checker::CheckRequest request{scenario, claims, mutant, 0, 12, {}};
  const std::string_view ids[] = {property};
  checker::Findings findings = check(ids, request);
  return findings.empty() ? props::Finding{} : std::move(findings.front().second);
}

}  // namespace stormproof::timeline
