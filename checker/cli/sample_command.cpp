// `simulate --samples N` and `--compare PROFILE`: the same schedules under one or several DDS
// profiles.
#include "checker/cli/sample_command.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "checker/cli/exit_code.hpp"
#include "checker/cli/run_monitor.hpp"
#include "checker/experiments/simulate/sample_report.hpp"
#include "checker/presentation/document/render.hpp"
#include "model/config/scenario_file.hpp"

namespace stormproof::cli {

namespace {

/// The command line that gives the same output.
std::string command_line(const SimulateArguments& arguments, const report::Sampling& sampling) {
  std::string command = "stormproof simulate " + arguments.scenario;
  for (const std::string& change : arguments.overrides) command += " --set '" + change + "'";
  command += fmt::format(" --samples {} --seed {}", sampling.wanted, sampling.first_seed);
  for (const std::string& profile : arguments.compare) command += " --compare " + profile;
  return command;
}

/// The scenario under each profile to compare with; the error of the first that cannot be read.
std::optional<std::string> add_profiles(const SimulateArguments& arguments,
                                        const model::Scenario& scenario,
                                        report::Sampling& sampling) {
  sampling.profiles.push_back({"this scenario", scenario, {}});
  for (const std::string& name : arguments.compare) {
    const auto dds = model::config::read_dds_profile(name, {}, model::config::SpecPath::standard());
    if (!dds) return to_string(dds.error());
    model::Scenario other = scenario;
    other.dds = *dds;
    sampling.profiles.push_back({name, std::move(other), {}});
  }
  return std::nullopt;
}

/// Runs everything; false if it was interrupted.
bool run_all(const SimulateArguments& arguments, report::Sampling& sampling) {
  const InterruptGuard guard;
  SampleProgressLine line{arguments.progress.value_or(isatty(STDERR_FILENO) != 0),
                          sampling.wanted * sampling.profiles.size()};
  std::size_t before = 0;
  for (report::SampledProfile& profile : sampling.profiles) {
    sampling::SampleOptions options;
    options.samples = sampling.wanted;
    options.first_seed = sampling.first_seed;
    options.on_progress = [&](std::size_t finished) {
      line.update(before + finished);
      return !InterruptGuard::interrupted();
    };
    profile.samples = sampling::sample_runs(profile.scenario, options);
    before += sampling.wanted;
  }
  return !InterruptGuard::interrupted();
}

}  // namespace

int sample(const SimulateArguments& arguments, const model::Scenario& scenario) {
  const auto& schedule = scenario.deployment.schedule;
  report::Sampling sampling;
  sampling.name = arguments.scenario;
  sampling.wanted = arguments.samples.value_or(1);
  sampling.first_seed = arguments.seed.value_or(schedule ? schedule->seed : 0);
  sampling.command = command_line(arguments, sampling);
  if (sampling.wanted > 1 && !schedule) {
    fmt::print(stderr,
               "stormproof: {}: has no schedule to sample; give the short form of the deployment\n"
               "  schedule: {{start: [0ms, 20ms], endpoints_done: [50ms, 120ms]}}\n",
               arguments.scenario);
    return bad_input;
  }
  if (const auto error = add_profiles(arguments, scenario, sampling)) {
    fmt::print(stderr, "stormproof: {}\n", *error);
    return bad_input;
  }
  const bool finished = run_all(arguments, sampling);
  fmt::print("{}", arguments.json ? report::to_json(sampling).dump(2) + "\n"
                                  : report::to_text(report::document_of(sampling)));
  const report::SampleSummary own = report::summarize(sampling.profiles.front().samples);
  return finished && own.completed == sampling.wanted ? established : inconclusive;
}

}  // namespace stormproof::cli
