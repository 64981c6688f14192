// Reads the scenario, varies it, prints the ranking and writes the plot.
#include "checker/cli/sensitivity_command.hpp"

#include <memory>

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "checker/cli/complain.hpp"
#include "checker/cli/exit_code.hpp"
#include "checker/cli/options.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/cli/run_monitor.hpp"
#include "checker/experiments/sensitivity/sensitivity_report.hpp"
#include "checker/presentation/document/render.hpp"
#include "model/config/scenario_file.hpp"
#include "model/config/tree/quantities.hpp"

namespace stormproof::cli {

namespace {

using sensitivity::Description;
using sensitivity::Measure;

/// Runs of each change if nothing else is said and they differ.
constexpr std::size_t usual_samples = 20;
constexpr std::size_t usual_pairs = 5;

struct SensitivityArguments {
  std::string scenario;
  std::vector<std::string> overrides;
  std::string range = "20%";
  std::string by = "completion";
  std::optional<std::size_t> samples;
  std::uint64_t seed = 0;
  std::string start_jitter;  ///< empty: that of the scenario's `vary`
  std::size_t pairs_of = 0;
  std::size_t shown = 15;
  std::size_t jobs = 0;
  std::string svg_file;
  bool json = false;
  std::optional<bool> progress;
};

/// "20%", "0.2" or "1/5"; nothing if it is none of these, or not between 0 and 1.
std::optional<double> parse_range(std::string text) {
  const bool is_percent = text.ends_with('%');
  if (is_percent) text.pop_back();
  const auto fraction = model::config::parse_fraction(text);
  if (!fraction) return std::nullopt;
  const double range = static_cast<double>(fraction->numerator) /
                       static_cast<double>(fraction->denominator) / (is_percent ? 100 : 1);
  if (range <= 0 || range >= 1) return std::nullopt;
  return range;
}

/// The options of the study; an error message if one is wrong.
model::config::Result<Description, std::string> describe(const SensitivityArguments& arguments,
                                                         const model::Scenario& scenario) {
  Description description;
  sensitivity::Options& options = description.options;
  const auto range = parse_range(arguments.range);
  if (!range) {
    return fmt::format(
        "--range {}: expected a percentage, decimal or fraction between 0 and 1, "
        "such as 20%, 0.2 or 1/5",
        arguments.range);
  }
  options.range = *range;
  if (!arguments.start_jitter.empty()) {
    const auto jitter = model::config::parse_duration(arguments.start_jitter);
    constexpr model::Nanoseconds longest{1'000'000'000'000};
    if (!jitter) return fmt::format("--start-jitter: {}", jitter.error());
    if (*jitter > longest) {
      return fmt::format("--start-jitter {}: expected at most 1000s", arguments.start_jitter);
    }
    options.start_jitter = *jitter;
  } else if (scenario.vary && scenario.vary->start_jitter) {
    options.start_jitter = *scenario.vary->start_jitter;
  }
  description.scenario = arguments.scenario;
  description.dds = scenario.dds;
  description.has_schedule = scenario.deployment.schedule.has_value();
  description.shown = arguments.shown;
  options.samples = arguments.samples.value_or(description.is_sampled() ? usual_samples : 1);
  if (options.samples > 1 && !description.is_sampled()) {
    return fmt::format(
        "{}: all {} samples would be the same run; give --start-jitter 10ms, or the deployment a "
        "schedule to draw from",
        arguments.scenario, options.samples);
  }
  options.first_seed = arguments.seed;
  options.by = arguments.by == "messages" ? Measure::messages : Measure::completion;
  options.pairs_of = arguments.pairs_of;
  options.threads = arguments.jobs;
  return description;
}

std::string command_line(const SensitivityArguments& arguments, const Description& description) {
  const sensitivity::Options& options = description.options;
  std::string command = "stormproof sensitivity " + arguments.scenario;
  for (const std::string& change : arguments.overrides) command += " --set '" + change + "'";
  command += " --range " + arguments.range;
  if (description.is_sampled()) {
    command += fmt::format(" --samples {} --seed {}", options.samples, options.first_seed);
  }
  if (options.start_jitter.count() > 0) {
    command += " --start-jitter " + model::config::print_duration(options.start_jitter);
  }
  if (options.by == Measure::messages) command += " --by messages";
  if (options.pairs_of > 0) command += fmt::format(" --pairs {}", options.pairs_of);
  return command;
}

int sensitivity_of(const SensitivityArguments& arguments) {
  const auto scenario = model::config::read_scenario(arguments.scenario, arguments.overrides,
                                                     model::config::SpecPath::standard());
  if (!scenario) return complain(to_string(scenario.error()));
  auto described = describe(arguments, *scenario);
  if (!described) return complain(described.error());
  Description& description = *described;
  description.command = command_line(arguments, description);
  OutputFile svg{arguments.svg_file};
  if (const auto error = svg.open_error()) return complain(*error);

  sensitivity::Report report;
  {
    const InterruptGuard guard;
    StatusLine line{arguments.progress.value_or(isatty(STDERR_FILENO) != 0)};
    description.options.on_progress = [&line](std::size_t finished, std::size_t runs) {
      if (line.due()) line.show(fmt::format("{} of {} runs", finished, runs));
      return !InterruptGuard::interrupted();
    };
    report = sensitivity::analyse(*scenario, description.options);
  }
  fmt::print("{}", arguments.json ? to_json(report, description).dump(2) + "\n"
                                  : report::to_text(document_of(report, description)));
  if (!report.finished) return inconclusive;
  if (svg.wanted()) svg.stream() << to_svg(report, description);
  if (const auto error = svg.commit()) return complain(*error);
  return established;
}

void add_study_options(CLI::App& command, SensitivityArguments& arguments) {
  command
      .add_option("--range", arguments.range, "How far each value goes down and up (default 20%)")
      ->type_name("RANGE");
  command.add_option("--by", arguments.by, "Rank by completion (default) or messages")
      ->check(CLI::IsMember({"completion", "messages"}))
      ->type_name("MEASURE");
  command
      .add_option("--samples", arguments.samples,
                  "Runs of each change with different start times (default 20 if they can differ)")
      ->check(CLI::Range(1, 100'000))
      ->type_name("N");
  command.add_option("--seed", arguments.seed, "Seed of the first start times (default 0)")
      ->type_name("S");
  command
      .add_option("--start-jitter", arguments.start_jitter,
                  "Each participant starts up to this much later")
      ->type_name("DURATION");
  command
      .add_option("--pairs", arguments.pairs_of,
                  fmt::format("Interactions of the first N knobs (default {})", usual_pairs))
      ->expected(0, 1)
      ->default_str(fmt::format("{}", usual_pairs))
      ->check(CLI::Range(2, 50))
      ->type_name("N");
}

}  // namespace

void declare_sensitivity(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<SensitivityArguments>();
  CLI::App* command = app.add_subcommand(
      "sensitivity", "Which knob matters: change every number a little and rank the effects");
  add_scenario(*command, arguments->scenario, arguments->overrides);
  add_study_options(*command, *arguments);
  command->add_option("--top", arguments->shown, "Knobs in the text and the plot (default 15)")
      ->check(CLI::Range(1, 10'000))
      ->type_name("N");
  command->add_option("--jobs", arguments->jobs, "Runs at the same time (default: all cores)")
      ->check(CLI::Range(1, 4'096))
      ->type_name("N");
  command->add_option("--svg", arguments->svg_file, "Write a tornado plot")->type_name("FILE");
  add_format(*command, arguments->json);
  add_progress(*command, arguments->progress);
  command->footer("Exit code: 0 all changes were run, 3 interrupted, 2 bad input.");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return sensitivity_of(*arguments); }; });
}

}  // namespace stormproof::cli
