// Run k of every failure has the same starts, and begins at the same share of the announcement
// period: the phase decides how long a lease still lasts. First all failures have one run, then
// all have two, so that whatever time there is is spread over all of them.
#include "checker/experiments/survive/survive.hpp"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "checker/experiments/trials/under_seed.hpp"
#include "model/config/knobs/life_knobs.hpp"
#include "model/config/knobs/numeric_knobs.hpp"
#include "model/config/scenario_file.hpp"
#include "model/implementations.hpp"
#include "model/life.hpp"

namespace stormproof::survive {

using model::Nanoseconds;
using model::Scenario;
using model::config::InputError;
using model::config::Result;

namespace {

/// How long nothing happens before the failure.
constexpr Nanoseconds rest{1'000'000'000};
constexpr Nanoseconds start_jitter{10'000'000};

/// What is kept of a run.
struct Run {
  std::optional<double> recovery;  ///< ns; absent: not within the limit
  double lost_pairs = 0;
  double messages = 0;
};

/// A failure of a version or of one of its cures, and the runs so far.
struct Line {
  Failure failure;
  std::vector<Run> runs = {};

  [[nodiscard]] std::size_t recovered() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(runs, [](const Run& run) { return run.recovery.has_value(); }));
  }
  template <class Value>
  [[nodiscard]] statistics::Quantiles quantiles_of(Value&& value) const {
    std::vector<double> values;
    for (const Run& run : runs) values.push_back(value(run));
    return statistics::quantiles(std::move(values));
  }
  [[nodiscard]] statistics::Quantiles recovery() const {
    return quantiles_of(
        [](const Run& run) { return run.recovery.value_or(statistics::unreached); });
  }
};

Outcome outcome_of(const Line& line) {
  return {line.failure,
          line.runs.size(),
          line.recovered(),
          line.recovery(),
          line.quantiles_of([](const Run& run) { return run.lost_pairs; }),
          line.quantiles_of([](const Run& run) { return run.messages; })};
}

Run run_of(const model::RunResult& result) {
  Run run;
  if (result.recovery_time) run.recovery = static_cast<double>(result.recovery_time->count());
  if (!result.until_discovery) return run;
  run.lost_pairs = static_cast<double>(result.until_discovery->forgotten);
  if (result.recovery_time && result.recovery_time->count() > 0) {
    run.messages = static_cast<double>(result.until_discovery->since_last_failure);
  }
  return run;
}

class Study {
 public:
  Study(const Request& request, const model::config::SpecPath& specs)
      : request_{request}, specs_{specs}, runner_{request.threads, [this](std::size_t runs, auto) {
                                                    return goes_on(runs);
                                                  }} {}

  Result<Report> run() {
    if (const auto error = settle()) return *error;
    std::vector<std::vector<Line>> lines;
    for (const Version& version : report_.versions) {
      for (const Failure& failure : failures_of(version.scenario, request_.lengths)) {
        lines.resize(report_.versions.size());
        lines[static_cast<std::size_t>(&version - report_.versions.data())].push_back({failure});
      }
      about_ += request_.samples * (lines[0].size() + 1);
    }
    std::size_t rounds = 0;
    for (; rounds < request_.samples && !is_over(rounds); ++rounds) {
      for (std::size_t v = 0; v < report_.versions.size(); ++v) {
        doing_ = report_.versions[v].name;
        run_all(report_.versions[v].scenario, rounds, lines[v], report_.versions[v].undiscovered);
      }
    }
    report_.unasked.note("runs of each failure", rounds, request_.samples);
    for (std::size_t v = 0; v < report_.versions.size(); ++v) {
      for (const Line& line : lines[v]) {
        if (!line.runs.empty()) report_.versions[v].outcomes.push_back(outcome_of(line));
      }
    }
    if (const auto error = try_cures(report_.versions.front(), rounds)) return *error;
    report_.interrupted = runner_.stopped();
    return std::move(report_);
  }

 private:
  [[nodiscard]] bool goes_on(std::size_t runs) const {
    return !request_.on_progress || request_.on_progress(doing_, runs, std::max(runs, about_));
  }
  /// Whether no further round of runs is begun; one is always made.
  [[nodiscard]] bool is_over(std::size_t rounds) const {
    if (runner_.stopped()) return true;
    const double used = request_.time.used();
    return rounds > 0 && used + used / static_cast<double>(rounds) > for_failures;
  }

  Result<Scenario> read(const std::vector<std::string>& overrides) {
    auto scenario = model::config::read_scenario(request_.scenario, overrides, specs_);
    if (!scenario) return scenario;
    if (scenario->deployment.life) {
      return InputError{request_.scenario + ": deployment.life",
                        "expected none: survive lets failures happen by itself"};
    }
    const bool waits = scenario->hosts || scenario->wireless.sender != model::Sender::backlog;
    if (waits && !scenario->dds.amendments) {
      report_.without_processors = true;
      scenario->hosts.reset();
      scenario->wireless.sender = model::Sender::backlog;
    }
    if (!model::config::knows_lives(*scenario)) {
      return InputError{request_.scenario + ": dds",
                        "its rules know no failures; expected nothing of the kind, " +
                            model::config::needed_for_lives(*scenario)};
    }
    scenario->run_until = model::RunUntil::completion;
    return scenario;
  }

  std::optional<InputError> settle() {
    auto own = read(request_.overrides);
    if (!own) return own.error();
    report_.versions.push_back({.name = "as it is", .scenario = *std::move(own)});
    for (const std::string& version : request_.versions) {
      std::vector<std::string> overrides = request_.overrides;
      overrides.push_back("dds=" + version);
      auto scenario = read(overrides);
      if (!scenario) return scenario.error();
      report_.versions.push_back({.name = version, .scenario = *std::move(scenario)});
    }
    return std::nullopt;
  }

  /// Run k of every failure; without one if discovery is not complete before. Returns whether all
  /// were made.
  void run_all(const Scenario& scenario, std::size_t k, std::vector<Line>& lines,
               std::size_t& undiscovered) {
    Scenario drawn = trials::under_seed(scenario, request_.seed + k, start_jitter);
    drawn.time_limit = request_.limit;
    std::optional<Nanoseconds> known;
    runner_.each(1, [&](std::size_t) {
      const auto before = runner_.simulate(drawn);
      if (before) known = before->discovery_time;
      return before.has_value();
    });
    if (runner_.stopped()) return;
    if (!known) {
      ++undiscovered;
      return;
    }
    const auto runs = runner_.run(lines.size(), [&](std::size_t n) -> std::optional<Run> {
      const auto result = runner_.simulate(failing(drawn, lines[n].failure, k, *known));
      return result ? std::optional{run_of(*result)} : std::nullopt;
    });
    for (std::size_t n = 0; n < lines.size(); ++n) {
      if (runs[n]) lines[n].runs.push_back(*runs[n]);
    }
  }

  /// The drawn scenario with the failure; everybody knows everybody since `known`.
  [[nodiscard]] Scenario failing(const Scenario& drawn, const Failure& failure, std::size_t k,
                                 Nanoseconds known) const {
    const double share = (static_cast<double>(k) + 0.5) /
                         static_cast<double>(std::max<std::size_t>(1, request_.samples));
    const Nanoseconds phase{
        static_cast<std::int64_t>(share * static_cast<double>(drawn.dds.spdp.period.count()))};
    Nanoseconds created;
    for (const model::Participant& one : drawn.deployment.participants) {
      created = std::max(created, one.endpoints_done);
    }
    const Nanoseconds at = failure.kind == Kind::network_at_start
                               ? Nanoseconds{known.count() / 2}
                               : std::max(known, created) + rest + phase;
    Scenario scenario = with(failure, at, drawn);
    scenario.time_limit = last_failure(scenario.deployment) + lease_of(drawn.dds) + request_.limit;
    return scenario;
  }

  std::optional<InputError> try_cures(Version& version, std::size_t rounds) {
    std::vector<Line> open;
    for (const Outcome& outcome : version.outcomes) {
      if (!outcome.is_survived()) open.push_back({outcome.failure});
    }
    if (open.empty()) return std::nullopt;
    for (const Cure& cure : cures_for(version.scenario)) {
      if (runner_.stopped() || request_.time.is_over()) {
        report_.unasked.left_out.push_back(cure.name);
        continue;
      }
      std::vector<std::string> overrides = request_.overrides;
      overrides.insert(overrides.end(), cure.overrides.begin(), cure.overrides.end());
      const auto scenario = read(overrides);
      if (!scenario) continue;  // of a profile that says otherwise
      doing_ = cure.name;
      about_ += rounds * (open.size() + 1);
      std::vector<Line> lines = open;
      std::size_t undiscovered = 0;
      for (std::size_t k = 0; k < rounds; ++k) run_all(*scenario, k, lines, undiscovered);
      for (const Line& line : lines) {
        version.attempts.push_back(
            {line.failure, cure, line.runs.size(), line.recovered(), line.recovery()});
      }
    }
    return std::nullopt;
  }

  /// Of the time, what failures may take; the rest is for cures.
  static constexpr double for_failures = 0.75;

  const Request& request_;
  const model::config::SpecPath& specs_;
  trials::Runner runner_;
  Report report_;
  std::string doing_;
  std::size_t about_ = 0;
};

}  // namespace

std::optional<Nanoseconds> Version::survived_from(Kind kind) const {
  std::optional<Nanoseconds> from;
  bool is_open = false;
  for (const Outcome& outcome : outcomes) {
    if (outcome.failure.kind != kind) continue;
    if (!outcome.is_survived()) {
      is_open = true;
      from.reset();
    } else if (is_open && !from) {
      from = outcome.failure.length;
    }
  }
  return from;
}

std::size_t Report::unsurvived() const {
  std::size_t count = 0;
  for (const Version& version : versions) {
    count += static_cast<std::size_t>(
        std::ranges::count_if(version.outcomes, [](const Outcome& o) { return !o.is_survived(); }));
  }
  return count;
}

Result<Report> survive(const Request& request, const model::config::SpecPath& specs) {
  return Study{request, specs}.run();
}

}  // namespace stormproof::survive
