// Reads the published figures, runs the plan, prints one form of the report and writes all of them.
#include "checker/cli/reproduce_command.hpp"

#include <filesystem>
#include <memory>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "checker/cli/complain.hpp"
#include "checker/cli/exit_code.hpp"
#include "checker/cli/options.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/cli/run_monitor.hpp"
#include "checker/experiments/reproduce/report.hpp"

namespace stormproof::cli {

namespace {

using reproduce::Report;

struct ReproduceArguments {
  std::string what;  ///< "paper"
  reproduce::PlanOptions plan;
  std::string format = "text";
  std::string directory;    ///< empty: no files
  std::size_t threads = 0;  ///< 0: one for each core
  std::optional<bool> progress;
};

std::string command_line(const ReproduceArguments& arguments) {
  std::string command = "stormproof reproduce paper";
  for (const std::string& id : arguments.plan.variants) command += " --profile " + id;
  return command + fmt::format(" --samples {}", arguments.plan.samples);
}

reproduce::Results run(const ReproduceArguments& arguments, const reproduce::Plan& plan) {
  const InterruptGuard guard;
  SampleProgressLine line{arguments.progress.value_or(isatty(STDERR_FILENO) != 0),
                          plan.run_count()};
  reproduce::RunLimits limits;
  limits.threads = arguments.threads;
  limits.on_progress = [&line](std::size_t finished) {
    line.update(finished);
    return !InterruptGuard::interrupted();
  };
  return reproduce::run(plan, limits);
}

/// All forms of the report; the reason if one cannot be written.
std::optional<std::string> write_all(const Report& report, const std::string& directory) {
  const std::pair<const char*, std::string> files[]{
      {"paper.txt", to_text(report)},
      {"paper.json", to_json(report).dump(2) + "\n"},
      {"paper.html", to_html(report)},
      {"figures.csv", figures_csv(report)},
      {"configurations.csv", configurations_csv(report)}};
  for (const auto& [name, text] : files) {
    OutputFile file{directory + "/" + name};
    if (auto error = file.open_error()) return error;
    file.stream() << text;
    if (auto error = file.commit()) return error;
  }
  fmt::print(stderr,
             "written to {}: paper.txt, paper.json, paper.html, figures.csv, "
             "configurations.csv\n",
             directory);
  return std::nullopt;
}

void print(const Report& report, const std::string& format) {
  if (format == "json") {
    fmt::print("{}\n", to_json(report).dump(2));
  } else if (format == "csv") {
    fmt::print("{}", figures_csv(report));
  } else if (format == "html") {
    fmt::print("{}", to_html(report));
  } else {
    fmt::print("{}", to_text(report));
  }
}

int reproduce_paper(const ReproduceArguments& arguments) {
  const auto specs = model::config::SpecPath::standard();
  const auto published = reproduce::read_published(specs);
  if (!published) return complain(to_string(published.error()));
  const auto plan = reproduce::make_plan(*published, arguments.plan, specs);
  if (!plan) return complain(to_string(plan.error()));
  if (!arguments.directory.empty()) {
    std::error_code error;
    std::filesystem::create_directories(arguments.directory, error);
    if (error) {
      return complain(
          fmt::format("-o {}: cannot be created: {}", arguments.directory, error.message()));
    }
  }
  Report report;
  report.command = command_line(arguments);
  report.version = STORMPROOF_VERSION;
  report.published = *published;
  report.results = run(arguments, *plan);
  report.figures = compare(report.published, report.results);
  print(report, arguments.format);
  const reproduce::Results& results = report.results;
  if (results.complete && results.evaluation_cpu_s > 0) {
    fmt::print(stderr, "{} configurations of profile paper on Wi-Fi: {:.2f} s of processor time\n",
               plan->configurations.size(), results.evaluation_cpu_s);
  }
  if (results.complete) {
    fmt::print(stderr, "{} runs: {:.1f} s of processor time\n", plan->run_count(),
               results.total_cpu_s);
  } else {
    fmt::print(stderr, "interrupted: {} of {} cases are finished\n", results.outcomes.size(),
               plan->cases.size());
  }
  if (!arguments.directory.empty()) {
    if (const auto error = write_all(report, arguments.directory)) return complain(*error);
  }
  return results.complete ? established : inconclusive;
}

}  // namespace

void declare_reproduce(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<ReproduceArguments>();
  CLI::App* command = app.add_subcommand(
      "reproduce", "The paper's evaluation: every published figure beside the model's");
  command->add_option("what", arguments->what, "What to reproduce: paper")
      ->required()
      ->check(CLI::IsMember({"paper"}))
      ->type_name("WHAT");
  add_repeatable(*command, "--profile", arguments->plan.variants,
                 "Only this variant (repeatable; default: all)")
      ->check(CLI::IsMember(reproduce::variant_ids()))
      ->type_name("ID");
  command
      ->add_option(
          "--samples", arguments->plan.samples,
          "Runs of each configuration with drawn start times (default 5; the paper has 15)")
      ->check(CLI::Range(1, 10'000))
      ->type_name("N");
  command
      ->add_option("--format", arguments->format, "Output format: text (default), json, csv, html")
      ->check(CLI::IsMember({"text", "json", "csv", "html"}))
      ->type_name("FORMAT");
  command
      ->add_option("-o,--output", arguments->directory,
                   "Write the report in all formats into this folder, too")
      ->type_name("DIR");
  command->add_option("--jobs", arguments->threads, "Runs at the same time (default: all cores)")
      ->check(CLI::Range(1, 4'096))
      ->type_name("N");
  add_progress(*command, arguments->progress);
  command->footer("Exit code: 0 everything was run, 3 interrupted, 2 bad input.");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return reproduce_paper(*arguments); }; });
}

}  // namespace stormproof::cli
