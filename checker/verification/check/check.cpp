// Runs the engines one after the other and combines what they found.
#include "checker/verification/check/check.hpp"

#include <algorithm>
#include <chrono>
#include <sstream>

#include "checker/engines/exact/exact.hpp"
#include "checker/engines/explorer/explorer.hpp"
#include "checker/engines/tables/tables.hpp"
#include "checker/engines/timeline/timeline.hpp"
#include "checker/verification/counterexample/write.hpp"

namespace stormproof::checker {

namespace {

using props::Engine;
using props::Finding;
using props::VerdictKind;

using EngineFunction = Findings (*)(std::span<const std::string_view>, const CheckRequest&);

/// In the order of cost: what is quick is known first.
constexpr std::array<std::pair<Engine, EngineFunction>, 4> engines{
    {{Engine::tables, tables::check},
     {Engine::exact_run, exact::check},
     {Engine::timelines, timeline::check},
     {Engine::explorer, explorer::check}}};

/// Strength of what a finding establishes; a violation and a dispute overrule all.
int rank(const Finding& finding) {
  switch (finding.kind) {
    case VerdictKind::violated:
      return 5;
    case VerdictKind::inconclusive:
      return finding.disputed ? 4 : 0;
    case VerdictKind::proved:
      return 3;
    case VerdictKind::bounded:
      return 2;
    case VerdictKind::sampled:
      return 1;
  }
  return 0;
}

std::vector<std::string_view> selected(std::vector<std::string_view> wanted) {
  std::vector<std::string_view> ids;
  for (const props::Property& property : props::catalogue()) {
    const bool named = std::find(wanted.begin(), wanted.end(), property.id) != wanted.end();
    if (wanted.empty() || named) ids.push_back(property.id);
  }
  return ids;
}

std::vector<std::string_view> for_engine(Engine engine,
                                         const std::vector<std::string_view>& properties) {
  std::vector<std::string_view> ids;
  for (const std::string_view id : properties) {
    const auto& list = props::find_property(id)->engines;
    if (std::find(list.begin(), list.end(), engine) != list.end()) ids.push_back(id);
  }
  return ids;
}

/// A counterexample that the simulator does not confirm is none: the finding says so instead.
void confirm(Finding& finding) {
  if (!finding.counterexample) return;
  std::ostringstream trace;
  const auto error = counterexample::write_counterexample(*finding.counterexample, trace);
  if (!error) return;
  finding.kind = VerdictKind::inconclusive;
  finding.how = "a violation was found that does not happen in the simulator: " + *error;
  finding.counterexample.reset();
}

PropertyResult result_of(std::string_view id, const std::vector<Findings>& answers) {
  PropertyResult result;
  result.property = props::find_property(id);
  for (const Findings& findings : answers) {
    for (const auto& [property, finding] : findings) {
      if (property != id) continue;
      result.findings.push_back(finding);
      confirm(result.findings.back());
    }
  }
  if (result.findings.empty()) {
    Finding none;
    none.how = "no engine has looked at it";
    result.findings.push_back(none);
  }
  result.deciding = deciding_finding(result.findings);
  result.verdict = result.decisive().kind;
  return result;
}

}  // namespace

const props::Counterexample* PropertyResult::counterexample() const {
  const props::Counterexample* best = nullptr;
  for (const Finding& finding : findings) {
    if (!finding.counterexample) continue;
    if (best == nullptr || finding.counterexample->event < best->event) {
      best = &*finding.counterexample;
    }
  }
  return best;
}

std::size_t CheckReport::count(VerdictKind kind) const {
  return static_cast<std::size_t>(
      std::count_if(results.begin(), results.end(),
                    [&](const PropertyResult& result) { return result.verdict == kind; }));
}

std::size_t deciding_finding(const std::vector<Finding>& findings) {
  const auto best =
      std::max_element(findings.begin(), findings.end(),
                       [](const Finding& a, const Finding& b) { return rank(a) < rank(b); });
  return static_cast<std::size_t>(best - findings.begin());
}

CheckReport check(std::vector<std::string_view> properties, const CheckRequest& request) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point started = Clock::now();
  const std::vector<std::string_view> ids = selected(std::move(properties));
  CheckReport report;
  std::vector<Findings> answers;
  for (const auto& [engine, function] : engines) {
    const std::vector<std::string_view> own = for_engine(engine, ids);
    if (own.empty()) continue;
    if (request.on_progress && !request.on_progress(props::name_of(engine))) {
      report.interrupted = true;
      break;
    }
    answers.push_back(function(own, request));
  }
  for (const std::string_view id : ids) report.results.push_back(result_of(id, answers));
  report.seconds = std::chrono::duration<double>(Clock::now() - started).count();
  return report;
}

}  // namespace stormproof::checker
