// Check requests for tests.
#pragma once

#include <span>

#include "checker/engines/smt/claims.hpp"
#include "checker/engines/timeline/theorem.hpp"
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

/// What an engine, a function `check`, says about one property.
template <class Check>
props::Finding finding_by(Check check, std::string_view property, const model::Scenario& scenario,
                          const checker::Mutant* mutant = nullptr,
                          smt::Options options = z3_only()) {
  smt::Claims claims{std::move(options)};
  const checker::CheckRequest request{scenario, claims, mutant, 0, 12, {}};
  checker::Findings findings = check(std::span{&property, 1}, request);
  return findings.empty() ? props::Finding{} : std::move(findings.front().second);
}

inline props::Finding finding_about(std::string_view property, const model::Scenario& scenario,
                                    const checker::Mutant* mutant = nullptr,
                                    smt::Options options = z3_only()) {
  return finding_by(check, property, scenario, mutant, std::move(options));
}

/// What becomes of a theorem that `prove` states.
template <class Prove>
props::Finding finding_of(Prove&& prove, smt::Options options = z3_only()) {
  smt::Claims claims{std::move(options)};
  const model::Scenario scenario;
  const checker::CheckRequest request{scenario, claims, nullptr, 0, 12, {}};
  Theorem theorem{"test", request};
  prove(theorem);
  return theorem.finish("test");
}

template <class Prove>
bool is_proved(Prove&& prove) {
  return finding_of(prove).kind == props::VerdictKind::proved;
}

}  // namespace stormproof::timeline
