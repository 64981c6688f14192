// Runs the engines one after the other.
#include "checker/verification/check/check.hpp"

#include <algorithm>
#include <chrono>

#include "checker/engines/calculus/calculus.hpp"
#include "checker/engines/exact/exact.hpp"
#include "checker/engines/explorer/explorer.hpp"
#include "checker/engines/tables/tables.hpp"
#include "checker/engines/timeline/timeline.hpp"
#include "checker/verification/check/combination.hpp"
#include "props/applicability.hpp"
#include "props/limits.hpp"

namespace stormproof::checker {

namespace {

using props::Engine;
using props::Finding;
using props::VerdictKind;

using EngineFunction = Findings (*)(std::span<const std::string_view>, const CheckRequest&);

/// In the order of cost: what is quick is known first.
constexpr std::array<std::pair<Engine, EngineFunction>, 5> engines{
    {{Engine::tables, tables::check},
     {Engine::calculus, calculus::check},
     {Engine::exact_run, exact::check},
     {Engine::timelines, timeline::check},
     {Engine::explorer, explorer::check}}};

std::vector<std::string_view> selected(const std::vector<std::string_view>& wanted,
                                       const model::Scenario& scenario) {
  std::vector<std::string_view> ids;
  for (const props::Property& property : props::catalogue()) ids.push_back(property.id);
  for (const std::string_view limit : props::limits_of(scenario)) ids.push_back(limit);
  if (wanted.empty()) return ids;
  std::erase_if(ids,
                [&](std::string_view id) { return std::ranges::find(wanted, id) == wanted.end(); });
  return ids;
}

std::vector<std::string_view> for_engine(Engine engine,
                                         const std::vector<std::string_view>& properties,
                                         const model::Scenario& scenario) {
  std::vector<std::string_view> ids;
  std::ranges::copy_if(properties, std::back_inserter(ids), [&](std::string_view id) {
    return props::applicability_of(id, scenario).is_decided_by(engine);
  });
  return ids;
}

/// Removes what does not apply to the scenario; returns it, with the reasons.
std::vector<std::pair<std::string_view, std::string_view>> take_inapplicable(
    std::vector<std::string_view>& ids, const model::Scenario& scenario) {
  std::vector<std::pair<std::string_view, std::string_view>> taken;
  std::erase_if(ids, [&](std::string_view id) {
    const std::string_view why = props::applicability_of(id, scenario).why_not;
    if (!why.empty()) taken.emplace_back(id, why);
    return !why.empty();
  });
  return taken;
}

PropertyResult result_of(std::string_view id, const std::vector<Findings>& answers,
                         const CheckRequest& request) {
  std::vector<Finding> about;
  for (const Findings& findings : answers) {
    for (const auto& [property, finding] : findings) {
      if (property == id) about.push_back(finding);
    }
  }
  return combined(*props::find_property(id), std::move(about), request);
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

CheckReport check(const std::vector<std::string_view>& properties, const CheckRequest& request) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point started = Clock::now();
  std::vector<std::string_view> ids = selected(properties, request.scenario);
  CheckReport report;
  if (properties.empty()) report.not_applicable = take_inapplicable(ids, request.scenario);
  std::vector<exact::RunHealth> runs;
  CheckRequest watched = request;
  std::map<std::string, Finding> known;
  watched.known = &known;
  watched.on_run = [&](const model::Scenario& scenario, const model::RunResult& result) {
    if (result.end != model::RunEnd::interrupted)
      runs.push_back(exact::health_of(scenario, result));
  };
  std::vector<Findings> answers;
  const auto goes_on = [&](Engine engine) {
    report.interrupted = request.on_progress && !request.on_progress(props::name_of(engine));
    return !report.interrupted;
  };
  for (const auto& [engine, function] : engines) {
    const std::vector<std::string_view> own = for_engine(engine, ids, request.scenario);
    if (own.empty()) continue;
    if (!goes_on(engine)) break;
    answers.push_back(function(own, watched));
    if (!goes_on(engine)) break;  // it may have stopped in the middle
  }
  if (!runs.empty()) report.outlook.emplace(std::move(runs));
  for (const std::string_view id : ids) report.results.push_back(result_of(id, answers, request));
  report.seconds = std::chrono::duration<double>(Clock::now() - started).count();
  return report;
}

}  // namespace stormproof::checker
