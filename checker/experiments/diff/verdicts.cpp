// Both checks run side by side, each with a solver of its own; what they find of the rules alone
// they share. One solver is enough here: the theorems are those of `stormproof check`, where a
// second one is asked.
//
// That a property is violated needs a counterexample; that an answer is inconclusive says how far a
// search came. So a lost answer is shown, and decides nothing unless the policy is strict. A
// dispute leaves nothing to compare.
#include "checker/experiments/diff/verdicts.hpp"

#include <algorithm>
#include <array>
#include <mutex>

#include "checker/engines/bounds/resting.hpp"
#include "checker/engines/smt/claims.hpp"
#include "checker/experiments/trials/runner.hpp"
#include "checker/verification/check/check.hpp"
#include "model/implementations.hpp"
#include "props/property.hpp"

namespace stormproof::diff {

namespace {

using props::VerdictKind;

checker::CheckReport check_one(const VerdictRequest& request, const model::Scenario& scenario,
                               const std::function<bool(std::string_view)>& on_progress,
                               checker::FoundOfRules& of_rules) {
  smt::Options solver;
  solver.seed = static_cast<unsigned>(request.seed);
  solver.second_solver = false;
  solver.interrupted = request.interrupted;
  smt::Claims claims{solver};
  checker::CheckRequest check{
      scenario, claims, nullptr, static_cast<unsigned>(request.seed), request.samples, on_progress};
  check.of_rules = &of_rules;
  return checker::check({}, check);
}

VerdictChange change_of(const checker::PropertyResult& before, const checker::PropertyResult& after,
                        model::ImplementationKind implementation, const Policy& policy) {
  VerdictChange change;
  change.property = before.property->id;
  change.statement = statement_of(*before.property, implementation);
  change.before = before.verdict;
  change.after = after.verdict;
  const auto how = [](const checker::PropertyResult& result) {
    const props::Finding& finding = result.decisive();
    return finding.engine.empty() ? finding.how : finding.engine + ": " + finding.how;
  };
  change.before_how = how(before);
  change.after_how = how(after);
  change.judgment = judge_verdicts(change.before, change.after, policy);
  if ((change.before == VerdictKind::violated) != (change.after == VerdictKind::violated)) {
    const props::Counterexample* found =
        (change.after == VerdictKind::violated ? after : before).counterexample();
    if (found != nullptr) change.counterexample = *found;
  }
  return change;
}

}  // namespace

Judgment judge_verdicts(VerdictKind before, VerdictKind after, const Policy& policy) {
  if (before == VerdictKind::disputed || after == VerdictKind::disputed) return Judgment::unclear;
  if (holds(before) && after == VerdictKind::violated) {
    return policy.verdicts ? Judgment::regression : Judgment::worse;
  }
  if (before == VerdictKind::violated && holds(after)) return Judgment::better;
  const bool lost = before != VerdictKind::inconclusive && after == VerdictKind::inconclusive;
  const bool newly_violated = before == VerdictKind::inconclusive && after == VerdictKind::violated;
  if (lost || newly_violated) return policy.strict_verdicts ? Judgment::unclear : Judgment::worse;
  return Judgment::same;
}

VerdictAnswer compare_verdicts(const VerdictRequest& request, const Policy& policy) {
  VerdictAnswer answer;
  answer.comparison.scenario = request.name;
  std::mutex mutex;
  bool stopped = false;
  const auto on_progress = [&](std::string_view engine) {
    const std::lock_guard lock{mutex};
    if (request.on_progress && !request.on_progress("verdicts: " + std::string{engine})) {
      stopped = true;
    }
    return !stopped;
  };
  std::array<checker::CheckReport, 2> reports;
  checker::FoundOfRules of_rules;
  trials::Runner{request.threads}.each(2, [&](std::size_t side) {
    const model::Scenario& scenario = side == 0 ? request.base : request.candidate;
    reports[side] = check_one(request, scenario, on_progress, of_rules);
    return true;
  });
  answer.interrupted = stopped || reports[0].interrupted || reports[1].interrupted;
  if (answer.interrupted) return answer;
  answer.comparison.done = true;
  const model::ImplementationKind implementation = model::kind_of(request.candidate.dds);
  // What does not apply to one of the two is not compared.
  for (const checker::PropertyResult& before : reports[0].results) {
    const auto after =
        std::ranges::find(reports[1].results, before.property, &checker::PropertyResult::property);
    if (after == reports[1].results.end()) continue;
    answer.comparison.properties.push_back(change_of(before, *after, implementation, policy));
  }
  return answer;
}

}  // namespace stormproof::diff
