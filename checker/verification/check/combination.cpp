// The order of strength, the confirmation of counterexamples, and contradictions between engines.
#include "checker/verification/check/combination.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "checker/engines/bounds/measure.hpp"
#include "checker/verification/counterexample/minimal.hpp"
#include "checker/verification/counterexample/write.hpp"
#include "model/implementations.hpp"
#include "props/applicability.hpp"

namespace stormproof::checker {

namespace {

using props::Engine;
using props::Finding;
using props::VerdictKind;

bool is_by(const Finding& finding, Engine engine) { return finding.engine == name_of(engine); }

/// What overrules what, and of equals which reaches further.
std::pair<int, int> rank(const Finding& finding) {
  const auto kind = static_cast<int>(finding.kind);
  // The calculus is about one deployment, without a loss.
  const int width = is_by(finding, Engine::tables)      ? 3
                    : is_by(finding, Engine::calculus)  ? 1
                    : is_by(finding, Engine::exact_run) ? 0
                                                        : 2;
  if (holds(finding.kind)) return {static_cast<int>(VerdictKind::observed) - kind, width};
  if (finding.kind == VerdictKind::inconclusive) return {-1, 0};
  return {kind, 0};  // violated, disputed
}

/// A counterexample that the simulator does not confirm is none: engine and simulator disagree.
void confirm(Finding& finding) {
  if (!finding.counterexample) return;
  const auto error = counterexample::refuted(*finding.counterexample);
  if (!error) return;
  finding.counterexample.reset();
  dispute(finding, "a violation was found that does not happen in the simulator: " + *error);
}

/// Leaves out of the counterexample what it does not need.
void minimize(Finding& finding, const CheckRequest& request) {
  if (!finding.counterexample) return;
  const std::string before = finding.counterexample->reason;
  finding.counterexample = counterexample::minimal(*std::move(finding.counterexample), [&] {
    return !request.on_progress || request.on_progress("making a counterexample smaller");
  });
  for (std::string& line : finding.details) {
    const std::size_t place = line.find(before);
    if (place != std::string::npos) {
      line.replace(place, before.size(), finding.counterexample->reason);
    }
  }
}

/// Whether what was proved says that this run cannot be.
bool excludes(const Finding& proof, const Finding& violation, const CheckRequest& request) {
  if (proof.kind != VerdictKind::proved) return false;
  if (is_by(proof, Engine::tables)) return true;
  // The timelines prove it up to the delay that they name, or the largest one of the scenario.
  if (!is_by(violation, Engine::exact_run)) return false;
  const auto largest = [&](const model::Scenario& scenario) {
    return exact::measure(scenario, request).largest_delay;
  };
  const model::Nanoseconds up_to =
      proof.longest_delay ? *proof.longest_delay : largest(request.scenario);
  return largest(violation.counterexample->scenario) <= up_to;
}

/// What two findings say of each other, if they contradict.
std::optional<Finding> contradiction(const std::vector<Finding>& findings,
                                     const CheckRequest& request) {
  for (const Finding& violation : findings) {
    if (violation.kind != VerdictKind::violated || !violation.counterexample) continue;
    for (const Finding& proof : findings) {
      if (!excludes(proof, violation, request)) continue;
      Finding dispute;
      props::dispute(dispute, proof.engine + " proves it (" + proof.how + "), and " +
                                  violation.engine +
                                  " breaks it: " + violation.counterexample->reason);
      return dispute;
    }
  }
  return std::nullopt;
}

}  // namespace

std::size_t deciding_finding(const std::vector<Finding>& findings) {
  const auto best =
      std::max_element(findings.begin(), findings.end(),
                       [](const Finding& a, const Finding& b) { return rank(a) < rank(b); });
  return static_cast<std::size_t>(best - findings.begin());
}

PropertyResult combined(const props::Property& property, std::vector<Finding> findings,
                        const CheckRequest& request) {
  PropertyResult result;
  result.property = &property;
  result.findings = std::move(findings);
  std::ranges::for_each(result.findings, confirm);
  if (auto dispute = contradiction(result.findings, request)) {
    result.findings.push_back(*std::move(dispute));
  }
  for (Finding& finding : result.findings) minimize(finding, request);
  if (result.findings.empty()) {
    Finding none;
    const props::Applicability answer = applicability_of(property, request.scenario);
    const std::string unproved{answer.why_not_provable};
    none.how = !answer.applies()  ? answer.in_words()
               : unproved.empty() ? "no engine has looked at it"
                                  : "no run shows it, and " + unproved;
    result.findings.push_back(none);
  }
  result.deciding = deciding_finding(result.findings);
  result.verdict = result.decisive().kind;
  return result;
}

}  // namespace stormproof::checker
