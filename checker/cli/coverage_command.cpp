// Reads the measurements, has them compared, and prints and draws the result.
#include "checker/cli/coverage_command.hpp"

#include <filesystem>
#include <fstream>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "checker/cli/complain.hpp"
#include "checker/cli/exit_code.hpp"
#include "checker/cli/options.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/cli/run_monitor.hpp"
#include "checker/evidence/coverage/report.hpp"
#include "checker/presentation/document/render.hpp"
#include "checker/presentation/json/dumped.hpp"

namespace stormproof::cli {

namespace {

using prediction::Observations;

struct CoverageArguments {
  std::string observations;
  prediction::ReadOptions read;
  std::vector<std::string> baseline_select;
  prediction::StudyRequest request;
  std::string output;  ///< folder; empty: none
  bool json = false;
  std::optional<bool> progress;
};

/// `word` for a shell.
std::string quoted(const std::string& word) {
  constexpr const char* plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,+%@";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? std::string{"'\\''"} : std::string{c};
  return result + "'";
}

/// The command line that gives the same report.
std::string command_line(const CoverageArguments& a) {
  std::string command = "stormproof coverage " + quoted(a.observations);
  const auto add = [&command](const char* option, const std::vector<std::string>& values) {
    for (const std::string& value : values) command += fmt::format(" {} {}", option, quoted(value));
  };
  add("--select", a.read.select);
  add("--dds", a.request.dds);
  add("--wireless", {a.request.wireless});
  if (!a.request.baseline.empty()) add("--baseline", {a.request.baseline});
  add("--baseline-select", a.baseline_select);
  add("--set", a.request.overrides);
  add("--change", a.request.change);
  add("--scope", a.request.scopes);
  if (a.request.channel == prediction::ChannelSource::row) command += " --channel row";
  if (a.read.completion == prediction::CompletionTime::strict) command += " --completion strict";
  return command + fmt::format(" --samples {} --seed {}", a.request.predict.samples,
                               a.request.predict.first_seed);
}

model::config::Result<Observations> read(const std::string& path,
                                         const prediction::ReadOptions& options) {
  using model::config::InputError;
  if (!std::filesystem::is_regular_file(path)) {
    return InputError{path, "no such file; expected measured runs, one JSON object per line"};
  }
  std::ifstream file{path};
  if (!file) return InputError{path, "cannot be read"};
  return prediction::read_observations(file, path, options);
}

/// Charts and page; what could not be written, or nothing.
std::optional<std::string> write_charts(const std::string& folder,
                                        const prediction::Heading& heading,
                                        const prediction::Study& study) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return folder + ": " + error.message();
  std::vector<prediction::ChartFile> files{{"coverage.html", to_html(document_of(heading, study))}};
  for (const prediction::ProfileStudy& profile : study.profiles) {
    for (auto& chart : prediction::charts(profile)) files.push_back(std::move(chart));
  }
  for (const prediction::ChartFile& chart : files) {
    OutputFile file{(std::filesystem::path{folder} / chart.name).string()};
    if (auto failed = file.open_error()) return failed;
    file.stream() << chart.svg;
    if (auto failed = file.commit()) return failed;
  }
  return std::nullopt;
}

model::config::Result<prediction::Study> run(const CoverageArguments& arguments,
                                             const Observations& measured,
                                             const Observations& baseline) {
  prediction::StudyRequest request = arguments.request;
  const InterruptGuard guard;
  StatusLine line{arguments.progress.value_or(isatty(STDERR_FILENO) != 0)};
  request.predict.on_progress = [&line](std::size_t finished, std::size_t all) {
    if (line.due()) line.show(fmt::format("{} of {} runs", finished, all));
    return !InterruptGuard::interrupted();
  };
  return prediction::study(measured.rows, baseline.rows, request);
}

int coverage(const CoverageArguments& arguments) {
  if (arguments.request.baseline.empty() &&
      !(arguments.baseline_select.empty() && arguments.request.change.empty())) {
    return complain("--baseline-select and --change need --baseline PROFILE");
  }
  const auto measured = read(arguments.observations, arguments.read);
  if (!measured) return complain(to_string(measured.error()));
  model::config::Result<Observations> baseline{Observations{}};
  if (!arguments.baseline_select.empty()) {
    baseline = read(arguments.observations, {arguments.read.completion, arguments.baseline_select});
    if (!baseline) return complain(to_string(baseline.error()));
  }
  const auto study = run(arguments, *measured, *baseline);
  if (!study) return complain(to_string(study.error()));
  const prediction::Heading heading{arguments.observations,
                                    command_line(arguments),
                                    measured->rows.size(),
                                    measured->not_selected,
                                    arguments.request.wireless,
                                    arguments.request.predict.samples,
                                    arguments.request.predict.first_seed};
  fmt::print("{}", arguments.json ? report::dumped(to_json(heading, *study))
                                  : to_text(document_of(heading, *study)));
  if (!arguments.output.empty()) {
    if (const auto error = write_charts(arguments.output, heading, *study)) return complain(*error);
  }
  return study->interrupted ? inconclusive : established;
}

void declare_model(CLI::App& command, CoverageArguments& arguments) {
  prediction::StudyRequest& request = arguments.request;
  add_repeatable(command, "--dds", request.dds, "DDS profile to predict with (repeatable)")
      ->required()
      ->type_name("PROFILE");
  command.add_option("--wireless", request.wireless, "Wireless profile")
      ->required()
      ->type_name("PROFILE");
  add_repeatable(command, "--set", request.overrides,
                 "Override a key of all scenarios: key.path=value (repeatable)")
      ->type_name("KEY=VALUE");
  command
      .add_option("--samples", request.predict.samples,
                  "Schedules drawn for each configuration (default 12)")
      ->check(CLI::Range(1, 100'000))
      ->type_name("N");
  command
      .add_option("--seed", request.predict.first_seed, "Seed of the first schedule (default 0)")
      ->type_name("S");
  command
      .add_option("--jobs", request.predict.threads, "Runs at the same time (default: all cores)")
      ->check(CLI::Range(1, 4'096))
      ->type_name("N");
  command
      .add_option_function<std::string>(
          "--channel",
          [&request](const std::string& source) {
            request.channel = source == "row" ? prediction::ChannelSource::row
                                              : prediction::ChannelSource::profile;
          },
          "profile (default): skip runs of other channels; row: each run's own channel")
      ->check(CLI::IsMember({"profile", "row"}))
      ->type_name("SOURCE");
}

void declare_rows(CLI::App& command, CoverageArguments& arguments) {
  command
      .add_option("observations", arguments.observations, "Measured runs, one JSON object per line")
      ->required()
      ->type_name("OBSERVATIONS");
  add_repeatable(command, "--select", arguments.read.select,
                 "Only rows with this value of a field (repeatable)")
      ->type_name("FIELD=VALUE");
  add_repeatable(command, "--scope", arguments.request.scopes,
                 "Only this scope: np1, np2, …, all, high_load (repeatable)")
      ->type_name("SCOPE");
  command
      .add_option_function<std::string>(
          "--completion",
          [&arguments](const std::string& kind) {
            arguments.read.completion = kind == "strict" ? prediction::CompletionTime::strict
                                                         : prediction::CompletionTime::app;
          },
          "Which completion time of a row: app (default, T_app_ms) or strict (T_strict_ms)")
      ->check(CLI::IsMember({"app", "strict"}))
      ->type_name("KIND");
}

void declare_baseline(CLI::App& command, CoverageArguments& arguments) {
  command
      .add_option("--baseline", arguments.request.baseline,
                  "Ratios to this DDS profile, with 90 % intervals")
      ->type_name("PROFILE");
  add_repeatable(command, "--baseline-select", arguments.baseline_select,
                 "Rows that were measured with the baseline, if those of --select were not")
      ->type_name("FIELD=VALUE");
  add_repeatable(command, "--change", arguments.request.change,
                 "As --set, but not for the baseline (repeatable)")
      ->type_name("KEY=VALUE");
}

}  // namespace

void declare_coverage(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<CoverageArguments>();
  CLI::App* command = app.add_subcommand(
      "coverage", "How well predictions fit measured runs: coverage, ratios, calibration");
  declare_rows(*command, *arguments);
  declare_model(*command, *arguments);
  declare_baseline(*command, *arguments);
  command
      ->add_option("-o,--output", arguments->output,
                   "Folder for charts (SVG) and one page of all (coverage.html)")
      ->type_name("DIR");
  add_format(*command, arguments->json);
  add_progress(*command, arguments->progress);
  command->footer("Exit code: 0 everything was predicted, 3 interrupted, 2 bad input.");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return coverage(*arguments); }; });
}

}  // namespace stormproof::cli
