// `stormproof reproduce paper`: reads the published figures, runs the plan, and puts the paper's
// evaluation beside them.
#include <filesystem>

#include <fmt/core.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/experiments/reproduce/reproduce_report.hpp"

namespace stormproof::cli {

namespace {

using reproduce::Report;

struct ReproduceArguments {
  std::string what;  ///< "paper"
  reproduce::PlanOptions plan;
  std::optional<std::size_t> samples;  ///< absent: as many as decide the figures
  std::string directory;               ///< empty: no files
  std::size_t threads = 0;             ///< 0: one for each core
};

reproduce::Results run_plan(const ReproduceArguments& arguments, const reproduce::Plan& plan,
                            const reproduce::Published& published, Session& session) {
  reproduce::RunLimits limits;
  if (!arguments.samples) limits.published = &published;
  limits.threads = arguments.threads;
  limits.on_progress = session.on_runs();
  return reproduce::run(plan, limits);
}

/// The report in all forms; what could not be written, or nothing.
std::string write_all(const Report& report, const std::string& directory, Answer& answer) {
  const auto path = [&](const char* name) {
    return (std::filesystem::path{directory} / name).string();
  };
  answer.files = {{path("paper.txt"), report::Format::text},
                  {path("paper.json"), report::Format::json},
                  {path("paper.html"), report::Format::html},
                  {path("figures.csv"), report::Format::csv}};
  OutputFile configurations{path("configurations.csv")};
  if (const auto error = configurations.open_error()) return *error;
  configurations.stream() << configurations_csv(report);
  if (const auto error = configurations.commit()) return *error;
  answer.notes.push_back(fmt::format(
      "written to {}: paper.txt, paper.json, paper.html, figures.csv, configurations.csv",
      directory));
  return {};
}

/// How long it took, which is never twice the same.
std::vector<std::string> times(const reproduce::Plan& plan, const reproduce::Results& results) {
  if (!results.complete) {
    return {fmt::format("{} of {} cases are finished", results.outcomes.size(), plan.cases.size())};
  }
  std::vector<std::string> lines;
  if (results.evaluation_cpu_s > 0) {
    lines.push_back(
        fmt::format("{} configurations of profile paper on Wi-Fi: {:.2f} s of processor time",
                    plan.configurations.size(), results.evaluation_cpu_s));
  }
  lines.push_back(
      fmt::format("{} runs: {:.1f} s of processor time", results.runs, results.total_cpu_s));
  return lines;
}

Outcome run(ReproduceArguments& arguments, Session& session) {
  const auto specs = model::config::SpecPath::standard();
  const auto published = reproduce::read_published(specs);
  if (!published) return published.error();
  if (arguments.samples) arguments.plan.samples = *arguments.samples;
  const auto plan = reproduce::make_plan(*published, arguments.plan, specs);
  if (!plan) return plan.error();
  if (!arguments.directory.empty()) {
    if (const auto error = make_folder("--output", arguments.directory)) return Complaint{*error};
  }
  Report report;
  report.version = STORMPROOF_VERSION;
  report.published = *published;
  report.results = run_plan(arguments, *plan, *published, session);
  report.figures = reproduce::compare(report.published, report.results);
  Answer answer;
  answer.document = document_of(report);
  answer.notes = times(*plan, report.results);
  answer.json = to_json(report);
  answer.csv = figures_csv(report);
  if (!arguments.directory.empty()) {
    answer.complaint = write_all(report, arguments.directory, answer);
  }
  return answer;
}

void declare(Options& options, ReproduceArguments& arguments) {
  options.text("what", arguments.what, "What to reproduce: paper", "WHAT")
      .required()
      .one_of({"paper"});
  options
      .texts("--profile", arguments.plan.variants, "Only this variant (repeatable; default: all)",
             "ID")
      .one_of(reproduce::variant_ids());
  options
      .number("--samples", arguments.samples,
              "Runs of each configuration with drawn start times (default: as many as decide the\n"
              "figures, 2 to 5; the paper has 15)",
              "N")
      .within(1, 10'000);
  options.jobs(arguments.threads);
  options.folder("-o,--output", arguments.directory,
                 "Write the report in all formats into this folder, too");
}

}  // namespace

void declare_reproduce(Frame& frame) {
  frame.add<ReproduceArguments>(
      {"reproduce",
       "The paper's evaluation: every published figure beside the model's",
       "Exit code: 0 everything was run, 3 interrupted, 2 bad input.",
       Formats::tables,
       {reproduce::json_schema}},
      declare, run);
}

}  // namespace stormproof::cli
