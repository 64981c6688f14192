// `simulate --samples N`, `--start-jitter TIME` and `--compare PROFILE`: the same start times under
// one or several DDS profiles.
#include <fmt/core.h>

#include "checker/cli/durations.hpp"
#include "checker/cli/simulate_request.hpp"
#include "checker/experiments/simulate/sample_report.hpp"
#include "checker/verification/check/next_steps.hpp"
#include "model/config/scenario_file.hpp"

namespace stormproof::cli {

namespace {

/// The scenario under each profile to compare with; the error of the first that cannot be read.
std::optional<model::config::InputError> add_profiles(const SimulateArguments& arguments,
                                                      const model::Scenario& scenario,
                                                      report::Sampling& sampling) {
  sampling.profiles.push_back({"this scenario", scenario, {}});
  for (const std::string& name : arguments.compare) {
    std::vector<std::string> changes{"dds=" + name};
    for (const std::string& given : arguments.overrides) {
      if (!given.starts_with("dds=") && !given.starts_with("dds.")) changes.push_back(given);
    }
    // As a scenario, so that what depends on the profile is right, and a rule between them is kept.
    auto read = model::config::read_scenario(arguments.scenario, changes,
                                             model::config::SpecPath::standard());
    if (!read) {
      model::config::InputError error = read.error();
      if (error.where == "--set " + changes.front()) error.where = name;  // that nobody wrote
      return error;
    }
    model::Scenario other = scenario;
    other.dds = read->dds;
    sampling.profiles.push_back({name, std::move(other), {}});
  }
  return std::nullopt;
}

/// Runs everything, or as much as there is time for.
void run_all(report::Sampling& sampling, Session& session) {
  const auto on_runs = session.on_runs();
  const std::size_t all = sampling.wanted * sampling.profiles.size();
  std::size_t before = 0;
  for (report::SampledProfile& profile : sampling.profiles) {
    trials::SampleOptions options;
    options.samples = sampling.wanted;
    options.first_seed = sampling.first_seed;
    options.start_jitter = sampling.start_jitter;
    options.on_progress = [&](std::size_t finished, std::size_t) {
      return on_runs(before + finished, all);
    };
    profile.samples = trials::sample_runs(profile.scenario, options);
    before += sampling.wanted;
  }
}

}  // namespace

Outcome sample(const SimulateArguments& arguments, const model::Scenario& scenario,
               Session& session) {
  report::Sampling sampling;
  sampling.name = arguments.scenario;
  sampling.words = checker::words_of(arguments.scenario, arguments.overrides);
  if (!arguments.start_jitter.empty()) {
    const auto jitter = parse_start_jitter(arguments.start_jitter, scenario);
    if (!jitter) return Complaint{jitter.error()};
    sampling.start_jitter = *jitter;
  }
  sampling.wanted =
      arguments.samples.value_or(sampling.is_drawn(scenario) ? trials::usual_samples : 1);
  sampling.first_seed = arguments.seed.value_or(model::own_seed(scenario));
  if (sampling.wanted > 1 && !sampling.is_drawn(scenario)) {
    return Complaint{arguments.scenario +
                     ": all runs would be the same; let every participant start up to 100 ms later "
                     "with\n  --start-jitter 100ms\nor give the deployment ranges of start times\n"
                     "  schedule: {start: [0ms, 20ms], endpoints_done: [50ms, 120ms]}\nor the "
                     "channel transmissions that fail\n  loss: {probability: 0.1}"};
  }
  if (const auto error = add_profiles(arguments, scenario, sampling)) return *error;
  run_all(sampling, session);
  Answer answer;
  answer.document = document_of(sampling);
  answer.json = to_json(sampling);
  return answer;
}

}  // namespace stormproof::cli
