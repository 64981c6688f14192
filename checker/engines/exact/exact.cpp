// Runs the scenario with the wanted monitors and puts their judgments into verdicts: once for a
// fixed scenario, once for each drawn schedule otherwise; live.quiescence has runs of its own.
#include "checker/engines/exact/exact.hpp"

#include <algorithm>
#include <chrono>

#include <fmt/core.h>

#include "checker/engines/exact/observed_run.hpp"
#include "checker/engines/exact/smallest_violation.hpp"
#include "model/implementations.hpp"
#include "props/limits.hpp"
#include "props/monitors/describe.hpp"

namespace stormproof::exact {

using model::RunEnd;
using props::Finding;
using props::time_text;
using props::VerdictKind;

namespace {

/// A mutated run may go wild: what it does not show early, it will not show.
constexpr std::uint64_t mutant_events = 400'000;

/// Of a drawn schedule: runs far beyond discovery cost many times a run up to it.
constexpr std::uint32_t quiet_samples = 3;

/// About what follows from progress: an incomplete run says nothing.
bool needs_completion(std::string_view property) {
  return property == "live.completion" || property == quiescence;
}

/// What the runs say about one property so far.
struct Judgment {
  std::string_view property;
  std::optional<props::Counterexample> counterexample;
  std::vector<std::string> remarks;  ///< of the first run
  std::vector<std::string> assumptions;
  std::uint32_t runs = 0;
  std::uint32_t incomplete = 0;
  std::uint32_t undecided = 0;
  bool interrupted = false;
  std::uint64_t events = 0;  ///< of the last run
  model::Nanoseconds until;
  std::uint64_t seed = 0;  ///< of the schedule that violates it
};

class Checker {
 public:
  Checker(std::span<const std::string_view> properties, const checker::CheckRequest& request)
      : request_{request} {
    std::vector<std::string_view> known = props::limits_of(request.scenario);
    for (const std::string_view id : props::monitored_properties(request.scenario))
      known.push_back(id);
    for (const std::string_view monitored : known) {
      if (std::ranges::find(properties, monitored) != properties.end()) {
        judgments_.emplace_back().property = monitored;
      }
    }
  }

  checker::Findings check() {
    if (judgments_.empty()) return {};
    const auto started = std::chrono::steady_clock::now();
    model::Scenario scenario = scenario_to_run(request_);
    model::Scenario specification = request_.scenario;
    drawn_ = model::is_drawn(scenario);
    const std::uint32_t runs = drawn_ ? std::max(1U, request_.samples) : 1;
    for (std::uint32_t k = 0; k < runs && !stopped_; ++k) {
      if (drawn_) {
        model::draw(scenario, request_.seed + k);
        specification.deployment = scenario.deployment;
        specification.wireless = scenario.wireless;
        specification.hosts = scenario.hosts;
      }
      run(scenario, specification, k);
    }
    checker::Findings findings;
    for (const Judgment& judgment : judgments_) {
      findings.emplace_back(judgment.property, finding(judgment));
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - started;
    for (auto& [property, answer] : findings) answer.seconds = took.count();
    return findings;
  }

 private:
  bool goes_on() {
    if (request_.on_progress && !request_.on_progress("exact run")) stopped_ = true;
    return !stopped_;
  }

  void run(const model::Scenario& scenario, const model::Scenario& specification,
           std::uint32_t sample) {
    const std::uint64_t seed = request_.seed + sample;
    const RunPlan plan{
        scenario, specification, request_.mutant == nullptr ? nullptr : &request_.mutant->rules,
        request_.mutant == nullptr ? 0 : mutant_events, [this] { return goes_on(); }};
    std::vector<std::string_view> during;
    bool after = false;
    for (const Judgment& judgment : judgments_) {
      if (judgment.counterexample) continue;
      if (judgment.property == quiescence)
        after = sample < quiet_samples;
      else
        during.push_back(judgment.property);
    }
    if (!during.empty() || request_.on_run) {
      const ObservedRun observed = run_observed(during, plan);
      if (request_.on_run) request_.on_run(observed.scenario, observed.result);
      judge(observed, seed);
    }
    if (after && !stopped_) judge(run_until_quiet(plan), seed);
  }

  void judge(const ObservedRun& run, std::uint64_t seed) {
    for (Judgment& judgment : judgments_) {
      const props::Monitor* const monitor = run.monitor(judgment.property);
      if (monitor == nullptr || judgment.counterexample) continue;
      ++judgment.runs;
      if (!run.result.completed()) ++judgment.incomplete;
      if (monitor->is_undecided()) ++judgment.undecided;
      judgment.interrupted = judgment.interrupted || run.result.end == RunEnd::interrupted;
      judgment.events = run.result.events;
      judgment.until = std::max(judgment.until, run.known_until);
      judgment.assumptions = monitor->assumptions();
      if (judgment.runs == 1) judgment.remarks = monitor->remarks();
      if (!monitor->violation()) continue;
      const props::Violation& violation = *monitor->violation();
      props::Counterexample found;
      found.property = judgment.property;
      found.scenario = run.scenario;
      found.scenario.deployment.schedule.reset();  // the times that were drawn remain
      found.event = violation.event;
      found.time = violation.time;
      found.reason = violation.reason;
      judgment.counterexample = std::move(found);
      judgment.seed = seed;
      judgment.remarks = monitor->remarks();
    }
  }

  Finding finding(const Judgment& judgment) {
    Finding answer;
    answer.engine = "exact run";
    answer.seed = request_.seed;
    answer.details = judgment.remarks;
    answer.assumptions = judgment.assumptions;
    if (judgment.counterexample) {
      violated(judgment, answer);
      return answer;
    }
    const bool silent = judgment.incomplete > 0 && needs_completion(judgment.property);
    if (judgment.interrupted || judgment.runs == 0 || judgment.undecided > 0 || silent) {
      inconclusive(judgment, answer);
      return answer;
    }
    if (drawn_) {
      answer.kind = VerdictKind::sampled;
      answer.how = fmt::format("{} runs with drawn schedules, seeds {} to {}", judgment.runs,
                               request_.seed, request_.seed + judgment.runs - 1);
    } else {
      answer.kind = VerdictKind::observed;
      answer.how = fmt::format("on the one trajectory of this scenario, {} events, up to {}",
                               judgment.events, time_text(judgment.until));
    }
    if (judgment.incomplete > 0) {
      answer.details.push_back(fmt::format("Discovery was not completed in {} of {} runs.",
                                           judgment.incomplete, judgment.runs));
    }
    return answer;
  }

  static void inconclusive(const Judgment& judgment, Finding& answer) {
    answer.kind = VerdictKind::inconclusive;
    if (judgment.interrupted || judgment.runs == 0) {
      answer.how = fmt::format("the run was interrupted at {}", time_text(judgment.until));
    } else if (judgment.undecided > 0) {
      answer.how = fmt::format("{} of {} runs, up to {}, are too short to say", judgment.undecided,
                               judgment.runs, time_text(judgment.until));
    } else {
      answer.how = fmt::format("discovery was not completed in {} of {} runs, up to {}",
                               judgment.incomplete, judgment.runs, time_text(judgment.until));
    }
  }

  void violated(const Judgment& judgment, Finding& answer) {
    const props::Counterexample& found = *judgment.counterexample;
    answer.kind = VerdictKind::violated;
    answer.how =
        drawn_ ? fmt::format("a run of this scenario, schedule drawn with seed {}", judgment.seed)
               : std::string{"the run of this scenario"};
    answer.counterexample = found;
    if (request_.mutant != nullptr) return;
    answer.counterexample =
        shortest(found, request_.scenario, judgment.property, [this] { return goes_on(); });
    if (answer.counterexample->event == found.event) return;
    answer.how += "; shown on a smaller deployment with the same profiles";
    answer.details.insert(answer.details.begin(),
                          fmt::format("In the scenario itself at event {}, {}: {}", found.event,
                                      time_text(found.time), found.reason));
  }

  const checker::CheckRequest& request_;
  std::vector<Judgment> judgments_;
  bool drawn_ = false;
  bool stopped_ = false;
};

}  // namespace

checker::Findings check(std::span<const std::string_view> properties,
                        const checker::CheckRequest& request) {
  return Checker{properties, request}.check();
}

}  // namespace stormproof::exact
