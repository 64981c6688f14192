// Options become overrides of `vary:` and `limits:`, so that the reader of scenarios refuses what
// is wrong in them, in the words of the option. Then: draw and run, write the counterexamples,
// print.
#include "checker/cli/fuzz_command.hpp"

#include <filesystem>
#include <memory>

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "checker/cli/complain.hpp"
#include "checker/cli/counterexample_files.hpp"
#include "checker/cli/exit_code.hpp"
#include "checker/cli/fuzz_input.hpp"
#include "checker/cli/options.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/cli/run_monitor.hpp"
#include "checker/experiments/fuzz/fuzz_report.hpp"
#include "checker/presentation/document/render.hpp"
#include "checker/verification/counterexample/story.hpp"
#include "model/config/knobs/effective.hpp"

namespace stormproof::cli {

namespace {

constexpr std::size_t usual_runs = 200;
constexpr std::size_t most_runs = 1'000'000;

/// Writes STEM.yaml, .jsonl, .svg, .mmd and .txt of every shrunk counterexample.
std::optional<std::string> write_files(const FuzzArguments& arguments,
                                       const fuzz::FuzzReport& report, fuzz::FuzzContext& context) {
  for (const fuzz::Judgment& judgment : report.judgments) {
    if (!judgment.shrunk) continue;
    std::error_code error;
    std::filesystem::create_directories(arguments.output_directory, error);
    if (error) {
      return fmt::format("--counterexamples {}: cannot be created: {}", arguments.output_directory,
                         error.message());
    }
    const std::string stem =
        (std::filesystem::path{arguments.output_directory} / std::string{judgment.id}).string();
    const props::Counterexample& found = judgment.shrunk->counterexample;
    if (auto failure = write_counterexample(found, stem)) return failure;
    const std::string description = fmt::format("# {}\n# found by: {}\n", found.reason,
                                                context.single(report, judgment.first_broken));
    if (auto failure = write_text(stem + ".yaml",
                                  description + model::config::effective_yaml(found.scenario))) {
      return failure;
    }
    if (auto failure = write_text(stem + ".txt", counterexample::story(found))) return failure;
    context.stems.emplace(judgment.id, stem);
  }
  return std::nullopt;
}

fuzz::FuzzReport run_fuzz(const FuzzArguments& arguments, const model::Scenario& scenario,
                          const fuzz::Ranges& ranges, std::vector<std::string> ids) {
  fuzz::FuzzOptions options;
  options.seconds = arguments.seconds;
  options.runs = arguments.runs.value_or(arguments.seconds ? most_runs : usual_runs);
  options.seed = arguments.seed;
  options.first = arguments.first;
  options.jobs = arguments.jobs;
  options.only = std::move(ids);
  const InterruptGuard guard;
  StatusLine status{arguments.progress.value_or(isatty(STDERR_FILENO) != 0)};
  options.on_progress = [&](const fuzz::FuzzProgress& progress) {
    if (status.due()) {
      const std::string runs = arguments.seconds
                                   ? fmt::format("{} runs", progress.finished)
                                   : fmt::format("{} of {} runs", progress.finished, options.runs);
      status.show(progress.shrinking.empty()
                      ? fmt::format("{}, {} violate something, {:.0f} s", runs, progress.violating,
                                    status.seconds())
                      : fmt::format("{}; shrinking {}, {:.0f} s", runs, progress.shrinking,
                                    status.seconds()));
    }
    return !InterruptGuard::interrupted();
  };
  return fuzz::fuzz(scenario, ranges, options);
}

int fuzz(const FuzzArguments& arguments) {
  const auto scenario = read_scenario(arguments);
  if (!scenario) return complain(to_string(scenario.error()));
  const auto ids = ids_to_judge(arguments, *scenario);
  if (!ids) return complain(to_string(ids.error()));
  std::vector<fuzz::KnobRange> knobs;
  for (const std::string& text : arguments.vary) {
    const auto range = fuzz::parse_knob_range(text, *scenario);
    if (!range) return complain(to_string(range.error()));
    knobs.push_back(*range);
  }
  const fuzz::Ranges ranges = fuzz::ranges_around(*scenario, std::move(knobs));
  const fuzz::FuzzReport report = run_fuzz(arguments, *scenario, ranges, *ids);
  fuzz::FuzzContext context{arguments.scenario, *scenario, command_line(arguments), {}};
  const auto failure = write_files(arguments, report, context);
  using Json = nlohmann::ordered_json;
  fmt::print(
      "{}",
      arguments.json
          ? to_json(report, context).dump(2, ' ', false, Json::error_handler_t::replace) + "\n"
          : report::to_text(document_of(report, context)));
  if (failure) return complain(*failure);
  if (report.violated()) return violated;
  return report.interrupted || report.runs.empty() ? inconclusive : established;
}

void declare_ranges(CLI::App& command, FuzzArguments& arguments) {
  command
      .add_option("--start-jitter", arguments.start_jitter,
                  "Each participant starts up to this much later (as vary.start_jitter; 0: none)")
      ->type_name("TIME");
  const auto ratio = [&](const char* name, std::string& value, const char* help) {
    command.add_option(name, value, help)->type_name("RATIO");
  };
  ratio("--loss", arguments.loss, "Each packet is lost with this probability, such as 2% or 0.02");
  ratio("--sizes", arguments.sizes, "Sizes of packets vary by so much, such as 10%");
  ratio("--delays", arguments.delays, "Airtime overheads, rates and delays vary by so much");
  ratio("--timers", arguments.timers, "Periods and delays of the DDS profile vary by so much");
  add_repeatable(command, "--vary", arguments.vary,
                 "Draw a numeric knob of a profile from a range (repeatable)")
      ->type_name("KEY=LOW..HIGH");
}

}  // namespace

void declare_fuzz(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<FuzzArguments>();
  CLI::App* command = app.add_subcommand(
      "fuzz", "Run variants of a scenario within ranges and look for one that breaks its limits");
  add_scenario(*command, arguments->scenario, arguments->overrides);
  add_format(*command, arguments->json);
  declare_ranges(*command, *arguments);
  add_repeatable(*command, "--limit", arguments->limits,
                 "Set a limit: completion, messages, amplification or backlog (repeatable)")
      ->type_name("NAME=VALUE");
  add_repeatable(*command, "--property", arguments->properties,
                 "Judge only by this property or limit.NAME, and by --limit (repeatable)")
      ->type_name("ID");
  command->add_option("--runs", arguments->runs, "Number of variants (default 200)")
      ->check(CLI::Range(std::size_t{1}, most_runs))
      ->type_name("N");
  command->add_option("--seconds", arguments->seconds, "Start no run after this time")
      ->check(CLI::Range(0.001, 1e6))
      ->type_name("S");
  command->add_option("--seed", arguments->seed, "Seed of the variants (default 0)")
      ->type_name("S");
  command->add_option("--first", arguments->first, "Number of the first variant (default 0)")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1'000'000'000'000}))
      ->type_name("K");
  command->add_option("--jobs", arguments->jobs, "Threads (default: one for each core)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  command
      ->add_option("--counterexamples", arguments->output_directory,
                   "Where counterexamples are written (default: counterexamples/)")
      ->type_name("DIR");
  add_progress(*command, arguments->progress);
  command->footer(
      "Exit code: 0 no run of the sample breaks anything, 1 one does, 2 bad input,\n"
      "3 interrupted, or no run finished.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return fuzz(*arguments); }; });
}

}  // namespace stormproof::cli
