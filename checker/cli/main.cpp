// The command line: parses arguments, calls the command, turns what nobody expected into exit
// code 70.
#include <exception>
#include <new>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "checker/cli/exit_code.hpp"
#include "checker/cli/replay_command.hpp"
#include "checker/cli/simulate_command.hpp"

namespace {

using namespace stormproof;

/// `--format text|json`, the same on every command.
void add_format(CLI::App& command, bool& json) {
  command
      .add_option_function<std::string>(
          "--format", [&json](const std::string& value) { json = value == "json"; },
          "Output format: text (default) or json")
      ->check(CLI::IsMember({"text", "json"}))
      ->type_name("FORMAT");
}

CLI::App* add_simulate(CLI::App& app, cli::SimulateArguments& arguments) {
  CLI::App* command = app.add_subcommand(
      "simulate", "Predict the discovery of a scenario: completion time, messages, channel use");
  command->add_option("scenario", arguments.scenario, "Scenario file, or name of a shipped one")
      ->required()
      ->type_name("SCENARIO");
  command
      ->add_option("--set", arguments.overrides,
                   "Override a key of the scenario: key.path=value (repeatable)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_format(*command, arguments.json);
  command->add_option("--trace", arguments.trace_file, "Write every event as JSON Lines")
      ->type_name("FILE");
  command
      ->add_option("--perfetto", arguments.perfetto_file,
                   "Write a trace that ui.perfetto.dev opens")
      ->type_name("FILE");
  command->add_flag_callback(
      "--progress", [&arguments] { arguments.progress = true; },
      "Show progress on stderr (default on a terminal)");
  command->add_flag_callback(
      "--no-progress", [&arguments] { arguments.progress = false; }, "Show no progress");
  CLI::Option* samples =
      command
          ->add_option("--samples", arguments.samples,
                       "Run N schedules drawn from deployment.schedule, on all cores")
          ->check(CLI::Range(1, 1'000'000))
          ->type_name("N");
  command->add_option("--seed", arguments.seed, "Seed of the first sampled schedule")
      ->needs(samples)
      ->type_name("S");
  CLI::Option* compare =
      command
          ->add_option("--compare", arguments.compare,
                       "Run another DDS profile on the same schedules, side by side (repeatable)")
          ->allow_extra_args(false)
          ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
          ->type_name("PROFILE");
  for (const char* recording : {"--trace", "--perfetto"}) {
    command->get_option(recording)->excludes(samples)->excludes(compare);
  }
  command->footer(
      "Exit code: 0 discovery completes, 3 it does not within the time limit, 2 bad input.");
  return command;
}

CLI::App* add_replay(CLI::App& app, cli::ReplayArguments& arguments) {
  CLI::App* command =
      app.add_subcommand("replay", "Run the scenario of a trace again and compare every event");
  command->add_option("trace", arguments.file, "File written by simulate --trace")
      ->required()
      ->type_name("FILE");
  add_format(*command, arguments.json);
  command->footer("Exit code: 0 identical, 1 different, 3 the trace ends early, 2 bad input.");
  return command;
}

int run(int argc, char** argv) {
  CLI::App app{"stormproof: will these ROS 2 / DDS participants discover each other in time?"};
  app.name("stormproof");
  app.set_version_flag("--version", "stormproof " STORMPROOF_VERSION);
  app.require_subcommand(1);
  cli::SimulateArguments simulate_arguments;
  cli::ReplayArguments replay_arguments;
  const CLI::App* simulate = add_simulate(app, simulate_arguments);
  add_replay(app, replay_arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? cli::established : cli::bad_input;
  }
  return *simulate ? cli::simulate(simulate_arguments) : cli::replay(replay_arguments);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "stormproof: out of memory; try a smaller deployment or a shorter limit\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "stormproof: internal error: {}\n", error.what());
  }
  return cli::internal_error;
}
