// The options of every command.
#include "checker/cli/command_line.hpp"

#include <memory>

#include "checker/cli/capture_command.hpp"
#include "checker/cli/check_command.hpp"
#include "checker/cli/conform_command.hpp"
#include "checker/cli/coverage_command.hpp"
#include "checker/cli/diff_command.hpp"
#include "checker/cli/draw_command.hpp"
#include "checker/cli/fuzz_command.hpp"
#include "checker/cli/mutate_command.hpp"
#include "checker/cli/options.hpp"
#include "checker/cli/profile_command.hpp"
#include "checker/cli/properties_command.hpp"
#include "checker/cli/replay_command.hpp"
#include "checker/cli/report_files.hpp"
#include "checker/cli/reproduce_command.hpp"
#include "checker/cli/sensitivity_command.hpp"
#include "checker/cli/simulate_command.hpp"
#include "checker/cli/sweep_command.hpp"
#include "checker/cli/tune_command.hpp"
#include "checker/cli/validate_command.hpp"

namespace stormproof::cli {

namespace {

void declare_simulate(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<SimulateArguments>();
  CLI::App* command = app.add_subcommand(
      "simulate", "Predict the discovery of a scenario: completion time, messages, channel use");
  add_scenario(*command, arguments->scenario, arguments->overrides);
  add_format(*command, arguments->json);
  command->add_option("--trace", arguments->trace_file, "Write every event as JSON Lines")
      ->type_name("FILE");
  command
      ->add_option("--perfetto", arguments->perfetto_file,
                   "Write a trace that ui.perfetto.dev opens")
      ->type_name("FILE");
  command
      ->add_option("--pcap", arguments->pcap_file,
                   "Write the packets as a capture, for Wireshark and stormproof capture")
      ->type_name("FILE");
  add_progress(*command, arguments->progress);
  CLI::Option* samples =
      command
          ->add_option("--samples", arguments->samples,
                       "Run N schedules drawn from deployment.schedule, on all cores")
          ->check(CLI::Range(1, 1'000'000))
          ->type_name("N");
  command->add_option("--seed", arguments->seed, "Seed of the first sampled schedule")
      ->needs(samples)
      ->type_name("S");
  CLI::Option* compare =
      add_repeatable(*command, "--compare", arguments->compare,
                     "Run another DDS profile on the same schedules, side by side (repeatable)")
          ->type_name("PROFILE");
  for (const char* recording : {"--trace", "--perfetto", "--pcap"}) {
    command->get_option(recording)->excludes(samples)->excludes(compare);
  }
  command->footer(
      "Exit code: 0 discovery completes, 1 a limit of the scenario is exceeded,\n"
      "3 it does not complete within the time limit, 2 bad input.");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return simulate(*arguments); }; });
}

void declare_check(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command = app.add_subcommand(
      "check", "Which properties hold for a scenario: proofs, exploration, counterexamples");
  add_scenario(*command, arguments->scenario, arguments->overrides);
  add_format(*command, arguments->format);
  add_report_files(*command, arguments->reports);
  add_repeatable(*command, "--property", arguments->properties,
                 "Check only this property (repeatable); 'stormproof properties' lists them")
      ->type_name("ID");
  command
      ->add_option("--require", arguments->require,
                   "Accept only verdicts of at least this kind: proved, bounded or sampled")
      ->check(CLI::IsMember({"proved", "bounded", "sampled"}))
      ->type_name("KIND");
  add_timeout(*command, arguments->timeout_seconds);
  command
      ->add_option("--counterexamples", arguments->output_directory,
                   "Where counterexamples are written (default: counterexamples/)")
      ->type_name("DIR");
  command
      ->add_option("--emit-test", arguments->emit_test,
                   "Write the counterexamples as GoogleTest cases")
      ->type_name("FILE");
  command
      ->add_option("--export", arguments->export_directory,
                   "Write the queries in SMT-LIB 2, one file for each property")
      ->type_name("DIR");
  command->add_flag("--single-solver", arguments->single_solver,
                    "Do not ask cvc5 for a second opinion");
  command->add_option("--seed", arguments->seed, "Seed of solvers and of drawn schedules")
      ->type_name("S");
  command
      ->add_option("--samples", arguments->samples,
                   "Runs of a scenario whose schedule is drawn (default 12)")
      ->check(CLI::Range(1, 1'000'000))
      ->type_name("N");
  command->add_flag("-v,--verbose", arguments->verbose,
                    "Show statements, invariants, witnesses and the findings of every engine");
  add_progress(*command, arguments->progress);
  command->footer(
      "Exit code: 0 everything holds, 1 a property is violated, 3 a verdict is inconclusive or\n"
      "weaker than --require, 2 bad input.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return check(*arguments); }; });
}

void declare_properties(CLI::App& app, Command& chosen) {
  const auto json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("properties", "List the properties that check knows");
  add_format(*command, *json);
  command->callback([json, &chosen] { chosen = [json] { return properties(*json); }; });
}

void declare_replay(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<ReplayArguments>();
  CLI::App* command = app.add_subcommand(
      "replay", "Run the scenario of a trace or counterexample again and compare every event");
  command->add_option("trace", arguments->file, "File written by simulate --trace or by check")
      ->required()
      ->type_name("FILE");
  add_format(*command, arguments->json);
  command->footer(
      "Exit code of a trace: 0 identical, 1 different, 3 the trace ends early.\n"
      "Of a counterexample: 1 the violation occurs, 3 it does not. 2 bad input.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return replay(*arguments); }; });
}

void declare_draw(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<DrawArguments>();
  CLI::App* command =
      app.add_subcommand("draw", "Draw a state machine from its transition table, or all of them");
  command->add_option("machine", arguments->machine, "Name of a machine; without it, all of them")
      ->type_name("MACHINE");
  command
      ->add_option_function<std::string>(
          "--format",
          [format = &arguments->format](const std::string& value) {
            *format = value == "svg"   ? draw::Format::svg
                      : value == "dot" ? draw::Format::dot
                                       : draw::Format::mermaid;
          },
          "mermaid (default), dot or svg")
      ->check(CLI::IsMember({"mermaid", "dot", "svg"}))
      ->type_name("FORMAT");
  CLI::Option* file =
      command->add_option("-o,--output", arguments->file, "Write to a file instead of stdout")
          ->type_name("FILE");
  command->add_option("--directory", arguments->directory, "Write one file for each machine")
      ->excludes(file)
      ->type_name("DIR");
  command->callback([arguments, &chosen] { chosen = [arguments] { return draw(*arguments); }; });
}

void declare_mutate(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<MutateArguments>();
  CLI::App* command = app.add_subcommand(
      "mutate", "Put mistakes into tables and rules, and see which property notices them");
  add_repeatable(*command, "--mutant", arguments->only, "Try only this mutant (repeatable)")
      ->type_name("ID");
  add_format(*command, arguments->json);
  add_timeout(*command, arguments->timeout_seconds);
  add_progress(*command, arguments->progress);
  command->footer("Exit code: 0 at least 95 % of the mutants are noticed, 1 fewer, 2 bad input.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return mutate(*arguments); }; });
}

}  // namespace

void declare_commands(CLI::App& app, Command& chosen) {
  declare_simulate(app, chosen);
  declare_check(app, chosen);
  declare_diff(app, chosen);
  declare_fuzz(app, chosen);
  declare_sensitivity(app, chosen);
  declare_sweep(app, chosen);
  declare_tune(app, chosen);
  declare_reproduce(app, chosen);
  declare_coverage(app, chosen);
  declare_capture(app, chosen);
  declare_conform(app, chosen);
  declare_validate(app, chosen);
  declare_properties(app, chosen);
  declare_profile(app, chosen);
  declare_replay(app, chosen);
  declare_draw(app, chosen);
  declare_mutate(app, chosen);
}

}  // namespace stormproof::cli
