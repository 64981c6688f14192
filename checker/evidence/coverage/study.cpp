// Builds the cases of all profiles, runs them together, and evaluates them.
#include "checker/evidence/coverage/study.hpp"

#include <algorithm>
#include <set>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "model/config/tree/suggestion.hpp"
#include "model/deployment.hpp"

namespace stormproof::prediction {

namespace {

using model::config::InputError;
using model::config::Result;

/// Adds the configurations that the profile can predict, and their cases. `foreign`: the rows were
/// measured with another system, so nothing can be said of their channel.
std::optional<InputError> add_cases(const std::vector<Configuration>& measured,
                                    const ScenarioOptions& options, bool foreign,
                                    ProfileStudy& profile, std::vector<Case>& cases) {
  for (const Configuration& configuration : measured) {
    const std::uint64_t participants =
        std::uint64_t{configuration.hosts} * configuration.participants_per_host;
    if (participants > model::Deployment::max_participants) {
      return InputError{"N_H, N_P", fmt::format("{} participants in all; expected at most {}",
                                                participants, model::Deployment::max_participants)};
    }
    auto scenario = scenario_of(configuration, options);
    if (!scenario) return scenario.error();
    const bool own_channel = options.channel == ChannelSource::row;
    const std::string difference = mismatch(configuration, *scenario, !own_channel && !foreign);
    if (!difference.empty()) {
      profile.skipped[difference] += configuration.runs.size();
      continue;
    }
    profile.dds = scenario->dds;
    Case next{std::move(*scenario),
              own_channel ? configuration.channel.loss.value_or(0) : 0,
              {},
              configuration.limit().has_value(),
              configuration.change};
    next.starts = start_times(configuration, next.scenario, options);
    profile.sampled = profile.sampled || next.sampled();
    profile.measured_starts += next.starts.measured();
    if (configuration.spread.step_ms > 0 && next.scenario.hosts) ++profile.spread;
    cases.push_back(std::move(next));
    profile.configurations.push_back(configuration);
  }
  return std::nullopt;
}

/// The scopes to report; those that were asked for, if any were.
std::vector<std::string> chosen_scopes(const std::vector<Pairing>& pairings,
                                       const std::vector<std::string>& asked) {
  std::vector<std::string> result;
  for (const std::string& scope : scopes(pairings)) {
    if (asked.empty() || std::ranges::count(asked, scope) > 0) result.push_back(scope);
  }
  return result;
}

void evaluate(ProfileStudy& profile, const std::vector<std::string>& asked) {
  const std::vector<Pairing> pairings = profile.pairings();
  for (const std::string& scope : chosen_scopes(pairings, asked)) {
    for (std::size_t m = 0; m < measure_count; ++m) {
      const auto measure = static_cast<Measure>(m);
      if (auto result = fit(pairings, scope, measure)) {
        profile.rows.push_back({scope, measure, std::move(*result)});
      }
    }
  }
}

void compare(ProfileStudy& changed, const ProfileStudy& baseline, bool measured,
             const std::vector<std::string>& asked) {
  const std::vector<Pairing> pairings = changed.pairings();
  const std::vector<Contrast> pairs = contrasts(pairings, baseline.pairings());
  for (const std::string& scope : chosen_scopes(pairings, asked)) {
    for (std::size_t m = 0; m < measure_count; ++m) {
      if (auto result = effect(pairs, scope, static_cast<Measure>(m), measured)) {
        changed.effects.push_back(std::move(*result));
      }
    }
  }
}

/// A scope that was asked for and that no run belongs to, with those that there are.
std::optional<InputError> refuse_scopes(const std::vector<Observation>& rows,
                                        const std::vector<std::string>& asked) {
  const std::vector<Configuration> measured = configurations(rows);
  std::vector<Pairing> pairings;
  for (const Configuration& configuration : measured) pairings.push_back({&configuration, nullptr});
  const std::vector<std::string> known = scopes(pairings);
  for (const std::string& scope : asked) {
    if (std::ranges::count(known, scope) > 0) continue;
    return InputError{"--scope " + scope,
                      fmt::format("no measured run is in this scope{}; expected one of {}",
                                  model::config::suggestion(scope, known), fmt::join(known, ", "))};
  }
  return std::nullopt;
}

/// The runs of the baseline whose deployment was measured with the intervention, too.
std::vector<Observation> with_partner(const std::vector<Observation>& baseline_rows,
                                      const std::vector<Observation>& rows) {
  const auto deployment = [](const Observation& run) {
    return std::tuple{run.hosts, run.participants_per_host, run.endpoints, run.spread};
  };
  std::set<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, Spread>> wanted;
  for (const Observation& run : rows) wanted.insert(deployment(run));
  std::vector<Observation> result;
  for (const Observation& run : baseline_rows) {
    if (wanted.contains(deployment(run))) result.push_back(run);
  }
  return result;
}

/// Which profile each part of the cases belongs to.
struct Plan {
  Study study;
  std::vector<Case> cases;
};

Result<Plan> plan(const std::vector<Observation>& rows,
                  const std::vector<Observation>& baseline_rows, const StudyRequest& request) {
  Plan plan;
  const bool foreign = !request.baseline.empty() && baseline_rows.empty();
  const auto add = [&](const std::string& name, const std::vector<Observation>& measured,
                       bool is_baseline) {
    ScenarioOptions options{name, request.wireless, request.overrides, request.channel,
                            request.words};
    if (!is_baseline) {
      options.overrides.insert(options.overrides.end(), request.change.begin(),
                               request.change.end());
    }
    ProfileStudy& profile = plan.study.profiles.emplace_back();
    profile.name = name;
    profile.is_baseline = is_baseline;
    return add_cases(configurations(measured), options, foreign && !is_baseline, profile,
                     plan.cases);
  };
  for (const std::string& name : request.dds) {
    if (const auto error = add(name, rows, false)) return *error;
  }
  if (!request.baseline.empty()) {
    const std::vector<Observation> measured = foreign ? rows : with_partner(baseline_rows, rows);
    if (const auto error = add(request.baseline, measured, true)) {
      return *error;
    }
  }
  return plan;
}

}  // namespace

const std::string& ProfileStudy::overall_scope() const {
  const auto all = std::ranges::find(rows, "all", &FitRow::scope);
  return all == rows.end() ? rows.front().scope : all->scope;
}

std::vector<Pairing> ProfileStudy::pairings() const {
  std::vector<Pairing> result;
  for (std::size_t k = 0; k < predictions.size(); ++k) {
    if (predictions[k].values[0].empty()) continue;  // stopped before its first run
    result.push_back({&configurations[k], &predictions[k]});
  }
  return result;
}

Result<Study> study(const std::vector<Observation>& rows,
                    const std::vector<Observation>& baseline_rows, const StudyRequest& request) {
  if (auto error = refuse_scopes(rows, request.scopes)) return *std::move(error);
  auto planned = plan(rows, baseline_rows, request);
  if (!planned) return planned.error();
  Study result = std::move(planned->study);
  const Predictions predictions = predict(planned->cases, request.predict);
  result.interrupted = !predictions.finished;
  auto next = predictions.cases.begin();
  for (ProfileStudy& profile : result.profiles) {
    const auto end = next + static_cast<std::ptrdiff_t>(profile.configurations.size());
    profile.predictions.assign(next, end);
    next = end;
  }
  const bool baseline_apart = !baseline_rows.empty();
  for (ProfileStudy& profile : result.profiles) {
    const bool hypothetical = !request.baseline.empty() && !baseline_apart && !profile.is_baseline;
    if (!hypothetical) evaluate(profile, request.scopes);
    if (!request.baseline.empty() && !profile.is_baseline) {
      compare(profile, result.profiles.back(), baseline_apart, request.scopes);
    }
  }
  return result;
}

}  // namespace stormproof::prediction
