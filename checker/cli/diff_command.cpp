// Reads both profiles and the policy, compares, writes the files, prints the report.
#include "checker/cli/diff_command.hpp"

#include <filesystem>
#include <memory>

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "checker/cli/complain.hpp"
#include "checker/cli/diff_files.hpp"
#include "checker/cli/exit_code.hpp"
#include "checker/cli/options.hpp"
#include "checker/cli/report_files.hpp"
#include "checker/cli/run_monitor.hpp"
#include "checker/experiments/diff/diff_report.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::cli {

namespace {

namespace fs = std::filesystem;
using diff::DiffReport;
using report::Format;

struct DiffArguments {
  std::string base, candidate;
  std::vector<std::string> overrides;  ///< of both profiles
  std::string grid;
  std::string scenario;
  std::string policy = "default";
  std::optional<std::size_t> samples;
  std::optional<std::uint64_t> seed;
  bool no_check = false;
  bool no_telling_apart = false;
  std::string directory = "diff";
  Format format = Format::text;
  std::vector<std::string> reports;  ///< FORMAT=FILE
  std::size_t jobs = 0;
  bool verbose = false;
  std::optional<bool> progress;
};

/// The report files of the command line; an error also if one of them could not be written in the
/// end, as the work before it takes a while.
model::config::Result<std::vector<ReportFile>> report_files(const DiffArguments& arguments) {
  auto files = parse_report_files(arguments.reports);
  if (!files) return files;
  for (const ReportFile& file : *files) {
    const fs::path folder = fs::path{file.path}.parent_path();
    if (folder.empty() || fs::is_directory(folder)) continue;
    return model::config::InputError{"--report " + file.path,
                                     fmt::format("there is no folder {}", folder.string())};
  }
  return files;
}

std::string render(Format format, const DiffReport& report, const diff::Files& files,
                   bool verbose) {
  const auto dumped = [](const nlohmann::ordered_json& json) {
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  };
  switch (format) {
    case Format::json:
      return dumped(to_json(report, files));
    case Format::markdown:
      return to_markdown(report, files);
    case Format::html:
      return to_html(report, files);
    case Format::junit:
      return to_junit(report, files);
    case Format::sarif:
      return dumped(to_sarif(report, files));
    case Format::text:
      break;
  }
  return to_text(report, files, verbose);
}

/// The command that gives the same answer.
std::string command_line(const DiffArguments& arguments) {
  std::string command = fmt::format("stormproof diff {} {}", report::shell_word(arguments.base),
                                    report::shell_word(arguments.candidate));
  for (const std::string& change : arguments.overrides) {
    command += " --set " + report::shell_word(change);
  }
  if (!arguments.grid.empty()) command += " --over " + report::shell_word(arguments.grid);
  if (!arguments.scenario.empty()) {
    command += " --scenario " + report::shell_word(arguments.scenario);
  }
  if (arguments.policy != "default") command += " --policy " + report::shell_word(arguments.policy);
  if (arguments.samples) command += fmt::format(" --samples {}", *arguments.samples);
  if (arguments.seed) command += fmt::format(" --seed {}", *arguments.seed);
  if (arguments.no_check) command += " --no-check";
  if (arguments.no_telling_apart) command += " --no-telling-apart";
  return command;
}

int exit_code(const DiffReport& report) {
  if (report.judgment == diff::Judgment::regression) return violated;
  return report.judgment == diff::Judgment::unclear ? inconclusive : established;
}

/// What is compared, from the command line; the error if something in it is wrong.
model::config::Result<diff::DiffRequest> request_of(const DiffArguments& arguments,
                                                    const model::config::SpecPath& specs) {
  const auto base = model::config::trace_dds_profile(arguments.base, arguments.overrides, specs);
  if (!base) return base.error();
  const auto candidate =
      model::config::trace_dds_profile(arguments.candidate, arguments.overrides, specs);
  if (!candidate) return candidate.error();
  const auto policy = diff::read_policy(arguments.policy, specs);
  if (!policy) return policy.error();
  diff::DiffRequest request;
  request.base = *base;
  request.candidate = *candidate;
  request.policy = *policy;
  request.grid = arguments.grid;
  request.scenario = arguments.scenario;
  request.samples = arguments.samples;
  request.seed = arguments.seed;
  request.check_verdicts = !arguments.no_check;
  request.tell_apart = !arguments.no_telling_apart;
  request.threads = arguments.jobs;
  request.command = command_line(arguments);
  return request;
}

int diff_of(const DiffArguments& arguments) {
  const model::config::SpecPath specs = model::config::SpecPath::standard();
  const auto reports = report_files(arguments);
  if (!reports) return complain(to_string(reports.error()));
  auto request = request_of(arguments, specs);
  if (!request) return complain(to_string(request.error()));
  const auto report = [&] {
    const InterruptGuard guard;
    StatusLine line{arguments.progress.value_or(isatty(STDERR_FILENO) != 0)};
    request->on_progress = [&line](std::string_view what) {
      if (line.due()) line.show(fmt::format("{}, {:.0f} s", what, line.seconds()));
      return !InterruptGuard::interrupted();
    };
    return diff::diff(*request, specs);
  }();
  if (!report) return complain(to_string(report.error()));
  diff::Files files;
  if (const auto error = write_diff_files(arguments.directory, *report, files)) {
    return complain(*error);
  }
  const auto rendered = [&](Format format) {
    return render(format, *report, files, arguments.verbose);
  };
  if (const auto error = write_report_files(*reports, rendered)) return complain(*error);
  fmt::print("{}", rendered(arguments.format));
  return exit_code(*report);
}

void add_comparison_options(CLI::App& command, DiffArguments& arguments) {
  command.add_option("base", arguments.base, "DDS profile before the change: name, file or XML")
      ->required()
      ->type_name("BASE");
  command.add_option("candidate", arguments.candidate, "DDS profile after it")
      ->required()
      ->type_name("CANDIDATE");
  add_repeatable(command, "--set", arguments.overrides,
                 "Override a key of both profiles: key.path=value (repeatable)")
      ->type_name("KEY=VALUE");
  command
      .add_option("--over", arguments.grid,
                  "Grid of deployments, or one scenario, to compare over (default: review)")
      ->type_name("GRID");
  command
      .add_option("--scenario", arguments.scenario,
                  "Scenario whose verdicts are compared (default: the least one of the grid)")
      ->type_name("SCENARIO");
  command
      .add_option("--policy", arguments.policy,
                  "What counts as a regression: name or file (default: default)")
      ->type_name("POLICY");
  command
      .add_option("--samples", arguments.samples,
                  "Schedules of each configuration (default: those of the policy, which grow)")
      ->check(CLI::Range(1, 100'000))
      ->type_name("N");
  command.add_option("--seed", arguments.seed, "Seed of the first schedule (default 0)")
      ->type_name("S");
  command.add_flag("--no-check", arguments.no_check, "Do not compare the verdicts of properties");
  command.add_flag("--no-telling-apart", arguments.no_telling_apart,
                   "Do not look for the smallest scenario that tells the profiles apart");
}

}  // namespace

void declare_diff(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<DiffArguments>();
  CLI::App* command = app.add_subcommand(
      "diff", "What a change of a DDS profile does: knobs, verdicts, costs, least difference");
  add_comparison_options(*command, *arguments);
  command
      ->add_option("-o,--output", arguments->directory,
                   "Where runs, charts and counterexamples are written (default: diff/)")
      ->type_name("DIR");
  add_format(*command, arguments->format);
  add_report_files(*command, arguments->reports);
  command->add_option("--jobs", arguments->jobs, "Runs at the same time (default: all cores)")
      ->check(CLI::Range(1, 4'096))
      ->type_name("N");
  command->add_flag("-v,--verbose", arguments->verbose, "Show all measures of all configurations");
  add_progress(*command, arguments->progress);
  command->footer(
      "Exit code: 0 no regression, 1 a regression by the policy, 3 inconclusive or interrupted,\n"
      "2 bad input.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return diff_of(*arguments); }; });
}

}  // namespace stormproof::cli
