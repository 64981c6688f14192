// Trials have a runner of their own: when three quarters of the time are over it stops, so that
// there is some left to hold what came out against new seeds.
#include "checker/experiments/fix/fix.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/core.h>

#include "checker/experiments/trials/usual_hosts.hpp"
#include "checker/experiments/tune/subject.hpp"
#include "model/config/scenario_file.hpp"
#include "model/config/vendor/vendor_knobs.hpp"

namespace stormproof::fix {

using compare::Candidate;
using launch::Cell;
using model::Nanoseconds;
using model::Scenario;
using model::config::InputError;
using model::config::Result;
using model::config::SpecPath;
using trials::Sample;

namespace {

/// Of the time, what is left for the last word.
constexpr double for_verdict = 0.25;
/// Of the time to try, what the search for settings may take.
constexpr double for_settings = 0.5;
/// A cure takes no longer than this times what discovery takes before.
constexpr double no_slower = 1.1;
/// Distance between the seeds of what is tried and of the verdict.
constexpr std::uint64_t next_seeds = 1'000'000;
constexpr Nanoseconds steps[] = {Nanoseconds{100'000'000}, Nanoseconds{400'000'000},
                                 Nanoseconds{1'000'000'000}};

double median_of(const Cell& cell) {
  return cell.completion.median.value_or(statistics::unreached);
}

bool all_fine(const Cell& cell) {
  return std::ranges::all_of(
      cell.runs, [](const Sample& run) { return run.health.health == exact::Health::fine; });
}

class Study {
 public:
  Study(const Request& request, const SpecPath& specs)
      : request_{request},
        specs_{specs},
        time_to_try_{request.time.part(1 - for_verdict)},
        trying_{request.threads,
                [this](std::size_t runs, std::size_t) { return may_try() && goes_on(runs); }},
        judging_{request.threads, [this](std::size_t, std::size_t) { return goes_on(0); }} {}

  Result<Report> run() {
    if (const auto error = settle()) return *error;
    doing_ = "as it is";
    report_.before = verdict_of({}, scenario());
    if (judging_.stopped()) return interrupted();
    if (all_fine(report_.before)) {
      report_.answer = Answer::fine;
      return std::move(report_);
    }
    for (const Kind kind : kinds) {
      if (request_.keep.contains(kind)) continue;
      const std::size_t first = report_.attempts.size();
      if (may_try() && !trying_.stopped()) {
        if (const auto error = try_kind(kind)) return *error;
      }
      if (!goes_on(trying_.finished())) return interrupted();
      if (!may_try() || trying_.stopped()) report_.untried.push_back(kind);
      if (confirm(first)) return std::move(report_);
      if (judging_.stopped()) return interrupted();
    }
    take_nearest();
    if (judging_.stopped()) return interrupted();
    report_.answer = report_.untried.empty() ? Answer::nothing_cures : Answer::unfinished;
    return std::move(report_);
  }

 private:
  [[nodiscard]] const Scenario& scenario() const { return report_.candidates.scenario; }
  [[nodiscard]] bool may_try() const { return !time_to_try_.is_over(); }
  [[nodiscard]] bool goes_on(std::size_t runs) const {
    return !request_.on_progress || request_.on_progress(doing_, runs, std::max(runs, about_));
  }

  Report interrupted() {
    report_.chosen = nearest();
    report_.interrupted = true;
    return std::move(report_);
  }

  std::optional<InputError> settle() {
    auto subject = tune::read_subject(request_.scenario, request_.overrides, "", specs_);
    if (!subject) return subject.error();
    preset_ = subject->preset;
    auto candidates = compare::candidates_of(request_.scenario, request_.overrides, specs_);
    if (!candidates) return candidates.error();
    report_.candidates = *std::move(candidates);
    Scenario& own = report_.candidates.scenario;
    own.time_limit = std::min(own.time_limit, launch_limit);
    own.run_until = model::RunUntil::completion;
    own_size_ = compare::size_of(own.deployment, compare::Grows::robots);
    return std::nullopt;
  }

  /// Under seeds that nothing is chosen by.
  Cell verdict_of(const std::optional<launch::Plan>& plan, const Scenario& one) {
    return runs_of(judging_, plan, one, request_.seed + next_seeds, request_.samples);
  }
  /// Holds an attempt against new seeds; false if that was stopped.
  bool judge(Attempt& made) {
    doing_ = "again, " + made.name;
    Cell cell = verdict_of(made.plan, made.scenario);
    if (judging_.stopped()) return false;
    made.confirmed = std::move(cell);
    return true;
  }
  Cell runs_of(trials::Runner& runner, const std::optional<launch::Plan>& plan, const Scenario& one,
               std::uint64_t seed, std::size_t samples) {
    auto runs = runner.run(samples, [&](std::size_t k) {
      return plan ? launch::sample_plan(runner, one, *plan, seed + k, request_.start_jitter)
                  : trials::sample_run(runner, one, seed + k, request_.start_jitter);
    });
    return launch::cell_of(trials::present(std::move(runs)));
  }

  void attempt(Attempt made) {
    doing_ = made.name;
    about_ = trying_.finished() + request_.trials;
    if (made.not_run.empty()) {
      made.runs = runs_of(trying_, made.plan, made.scenario, request_.seed, request_.trials);
      if (made.runs.runs.size() < request_.trials)
        made.not_run = may_try() ? compare::interrupted : "no time";
    }
    report_.attempts.push_back(std::move(made));
  }

  std::optional<InputError> try_kind(Kind kind) {
    if (kind == Kind::settings) return try_settings();
    for (const Candidate& one : report_.candidates.list) {
      if (kind_of(one) == kind && !one.is_own) attempt(made_of(kind, one));
    }
    if (kind == Kind::launch) try_plans();
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Kind> kind_of(const Candidate& one) const {
    namespace vendor = model::config::vendor;
    if (one.placement == compare::Placement::one_process_per_host) return Kind::launch;
    if (vendor::vendor_of_preset(one.profile) != vendor::vendor_of_preset(preset_)) {
      return Kind::vendor;
    }
    const model::DdsProfile& own = scenario().dds;
    const bool same_way =
        one.dds.discovery == own.discovery && one.dds.allow_multicast == own.allow_multicast;
    if (same_way && one.skipped.empty()) return std::nullopt;  // the search has its settings
    return Kind::discovery;
  }

  [[nodiscard]] Attempt made_of(Kind kind, const Candidate& one) const {
    const compare::Instance instance =
        compare::instance_of(report_.candidates, one, compare::Grows::robots, own_size_);
    return {kind, one.name, one, {}, instance.scenario, {}, {}, instance.refused};
  }

  /// First what helps most often, alone; the search only if that does not cure.
  std::optional<InputError> try_settings() {
    if (const auto dds = launch::with_large_send_buffer(scenario().dds)) {
      Candidate one;
      one.id = "tuned";
      one.name = "send buffer 4 MB";
      one.change = "sendBufferSize of the UDP transport";
      one.profile = preset_;
      one.dds = *dds;
      one.wireless = scenario().wireless;
      attempt(made_of(Kind::settings, one));
      if (cures(report_.attempts.back())) return std::nullopt;
    }
    tune::Options options;
    options.budget = request_.budget;
    options.samples = 6;
    options.seed = request_.seed;
    options.start_jitter = request_.start_jitter;
    options.threads = request_.threads;
    options.on_progress = [this](std::string_view doing, std::size_t runs, std::size_t about) {
      doing_ = fmt::format("settings, {}", doing);
      about_ = about;
      return may_try() && goes_on(runs);
    };
    options.time = time_to_try_.part(for_settings);
    const auto one = compare::tuned_candidate(report_.candidates, request_.scenario,
                                              request_.overrides, options, specs_);
    if (!one) return one.error();
    attempt(made_of(Kind::settings, *one));
    return std::nullopt;
  }

  /// Plans as it is, with the best settings, and with the best other way.
  void try_plans() {
    Attempt as_it_is{Kind::launch, "", {}, {}, scenario(), {}, {}, {}};
    if (scenario().deployment.life) {
      as_it_is.name = "launch plans";
      as_it_is.not_run = "a launch plan is about first starts, and the scenario has a life";
      attempt(std::move(as_it_is));
      return;
    }
    as_it_is.candidate.id = "as-it-is";
    std::vector<Attempt> bases{as_it_is};
    for (const Kind kind : {Kind::settings, Kind::discovery}) {
      if (const auto best = nearest(kind)) bases.push_back(report_.attempts[*best]);
    }
    const std::optional<model::Processor> hosts = usual_hosts();
    const auto plans = launch::plans_for(
        scenario().deployment, {std::begin(steps), std::end(steps)}, scenario().time_limit);
    for (const Attempt& base : bases) {
      for (std::size_t k = 1; k < plans.size(); ++k) {  // the first is the deployed one
        Attempt made = base;
        made.kind = Kind::launch;
        made.name = (base.name.empty() ? "" : base.name + ", ") + launch::words_of(plans[k]);
        made.plan = plans[k];
        if (hosts) made.scenario.hosts = hosts;
        attempt(std::move(made));
      }
    }
  }

  /// Who starts when others have everything is answered as fast as a processor can.
  std::optional<model::Processor> usual_hosts() {
    if (!trials::lacks_hosts(scenario())) return std::nullopt;
    const auto with = model::config::read_scenario(
        request_.scenario, trials::with_usual_hosts(request_.overrides), specs_);
    if (!with) return std::nullopt;
    report_.usual_hosts = true;
    return with->hosts;
  }

  [[nodiscard]] bool cures(const Attempt& made) const {
    return made.not_run.empty() && cures(made.runs, made.scenario);
  }
  [[nodiscard]] bool cures(const Cell& cell, const Scenario& one) const {
    if (cell.runs.empty() || failures(cell, one) > 0) return false;
    if (failures(report_.before, scenario()) == 0 && !all_fine(cell)) return false;
    return median_of(cell) <= no_slower * median_of(report_.before);
  }

  /// Of the attempts from `first` on that cure, the soonest that does so under new seeds, too.
  bool confirm(std::size_t first) {
    std::vector<std::size_t> hopeful;
    for (std::size_t k = first; k < report_.attempts.size(); ++k) {
      if (cures(report_.attempts[k])) hopeful.push_back(k);
    }
    std::ranges::stable_sort(hopeful, {},
                             [this](std::size_t k) { return median_of(report_.attempts[k].runs); });
    for (const std::size_t k : hopeful) {
      Attempt& made = report_.attempts[k];
      if (!judge(made)) return false;
      if (!cures(*made.confirmed, made.scenario)) continue;
      report_.chosen = k;
      report_.answer = Answer::cured;
      return true;
    }
    return false;
  }

  /// Which fails in the fewest runs, and of these is soonest, if that is better than before.
  [[nodiscard]] std::optional<std::size_t> nearest(std::optional<Kind> kind = {}) const {
    const auto rank = [](const Cell& cell, const Scenario& one) {
      const auto runs = static_cast<double>(std::max<std::size_t>(cell.runs.size(), 1));
      return std::pair{static_cast<double>(failures(cell, one)) / runs, median_of(cell)};
    };
    std::optional<std::size_t> best;
    auto least = rank(report_.before, scenario());
    for (std::size_t k = 0; k < report_.attempts.size(); ++k) {
      const Attempt& made = report_.attempts[k];
      if ((kind && made.kind != *kind) || !made.not_run.empty()) continue;
      const auto own = rank(made.confirmed.value_or(made.runs), made.scenario);
      if (own >= least) continue;
      least = own;
      best = k;
    }
    return best;
  }

  void take_nearest() {
    report_.chosen = nearest();
    if (!report_.chosen) return;
    Attempt& made = report_.attempts[*report_.chosen];
    if (!made.confirmed) judge(made);
  }

  static constexpr Nanoseconds launch_limit{60'000'000'000};

  const Request& request_;
  const SpecPath& specs_;
  trials::Budget time_to_try_;
  std::string preset_;
  std::uint32_t own_size_ = 0;
  std::string doing_;
  std::size_t about_ = 0;
  trials::Runner trying_, judging_;
  Report report_;
};

}  // namespace

const char* name_of(Kind kind) {
  constexpr std::array names{"settings", "discovery", "launch", "vendor"};
  return names[static_cast<std::size_t>(kind)];
}

const char* name_of(Answer answer) {
  constexpr std::array names{"fine", "cured", "nothing_cures", "unfinished"};
  return names[static_cast<std::size_t>(answer)];
}

const Cell* Report::after() const {
  if (!chosen) return nullptr;
  const Attempt& made = attempts[*chosen];
  return made.confirmed ? &*made.confirmed : &made.runs;
}

std::size_t failures(const Cell& cell, const Scenario& scenario) {
  const bool limited = scenario.limits && scenario.limits->completion;
  return static_cast<std::size_t>(std::ranges::count_if(cell.runs, [&](const Sample& run) {
    if (!run.discovery_time || run.health.health == exact::Health::storm) return true;
    return limited && *run.discovery_time > *scenario.limits->completion;
  }));
}

Result<Report> fix(const Request& request, const SpecPath& specs) {
  return Study{request, specs}.run();
}

}  // namespace stormproof::fix
