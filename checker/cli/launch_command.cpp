// `stormproof launch SCENARIO`: when to start which process, and the files with which a robot does.
#include "checker/cli/commands.hpp"
#include "checker/cli/durations.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/cli/output_folder.hpp"
#include "checker/experiments/launch/launch_report.hpp"

namespace stormproof::cli {

namespace {

struct LaunchArguments {
  launch::Request request;
  std::string limit;  ///< a duration; empty: 60 s
  std::vector<std::string> steps;
  std::string start_jitter = "10ms";
  std::string folder;  ///< of what a robot runs; empty: none
  OutputFile svg;
};

constexpr model::Nanoseconds longest{1'000'000'000'000};

/// What is wrong with the options, or nothing; the request is complete then.
std::optional<std::string> complete(LaunchArguments& arguments) {
  launch::Request& request = arguments.request;
  if (!arguments.limit.empty()) {
    const auto limit = parse_duration("--limit", arguments.limit, longest);
    if (!limit) return limit.error();
    if (limit->count() == 0) return "--limit 0s: expected more than that";
    request.limit = *limit;
  }
  const auto jitter = parse_duration("--start-jitter", arguments.start_jitter, longest);
  if (!jitter) return jitter.error();
  request.start_jitter = *jitter;
  request.steps = launch::usual_steps();
  if (!arguments.steps.empty()) request.steps.clear();
  for (const std::string& text : arguments.steps) {
    const auto step = parse_duration("--step", text, longest);
    if (!step) return step.error();
    if (step->count() == 0) return "--step 0s: expected more than that; all at once is a plan, too";
    request.steps.push_back(*step);
  }
  return std::nullopt;
}

std::vector<std::string> write_files(OutputFolder& folder, const launch::Report& report,
                                     const launch::Request& request) {
  std::vector<std::string> written;
  const auto best = report.best();
  if (!best) return written;
  for (const launch::LaunchFile& file :
       launch_files(report.settings[best->setting], report.rows[best->row].plan, request)) {
    if (const auto path = folder.write(file.name, file.text)) written.push_back(*path);
  }
  return written;
}

Outcome run(LaunchArguments& arguments, Session& session) {
  launch::Request& request = arguments.request;
  if (const auto error = complete(arguments)) return Complaint{*error};
  std::optional<OutputFolder> folder;
  if (!arguments.folder.empty()) {
    folder.emplace("--export", arguments.folder, "launch", std::vector{request.scenario});
    if (const auto error = folder->prepare()) return Complaint{*error};
  }
  request.on_progress = session.on_study();
  const auto report = launch::launch(request, model::config::SpecPath::standard());
  if (!report) return report.error();
  Answer answer;
  if (Session::time().is_limited() && arguments.limit.empty()) {
    answer.notes.emplace_back(
        "stormproof: --time is the time by the clock; how long a run may take is --limit");
  }
  std::vector<std::string> written;
  if (folder) {
    written = write_files(*folder, *report, request);
    answer.complaint = folder->error().value_or("");
  }
  answer.document = document_of(*report, request, written);
  Session::note_interruption(answer.document);
  answer.json = to_json(*report, request, written);
  if (arguments.svg.wanted()) arguments.svg.stream() << to_svg(*report);
  return answer;
}

void declare(Options& options, LaunchArguments& arguments) {
  launch::Request& request = arguments.request;
  options.scenario(request.scenario, request.overrides);
  options.text("--limit", arguments.limit, "What takes longer is not complete (default 60s)",
               "TIME");
  options.texts("--step", arguments.steps,
                "Time between two starts of a spread (repeatable; default: 10ms to 2s)", "TIME");
  options.number("--samples", request.samples, "Runs of each plan and setting (default 5)", "N")
      .within(1, 100'000);
  options.seed(request.seed, "Seed of the first run (default 0)");
  options.text("--start-jitter", arguments.start_jitter,
               "Each process starts up to this much later than planned (default 10ms)", "TIME");
  options.flag("--join", request.join, "Also what one more robot costs the running fleet");
  options.folder("--export", arguments.folder,
                 "Write launch files and systemd units of the soonest plan here");
  options.svg(arguments.svg, "Plot completion over the spread of starts");
  options.jobs(request.threads);
}

}  // namespace

void declare_launch(Frame& frame) {
  frame.add<LaunchArguments>(
      {"launch",
       "When to start which process, so that everybody knows everybody soonest",
       "Exit code: 0 compared, 3 interrupted, 2 bad input.",
       Formats::pages,
       {launch::json_schema}},
      declare, run);
}

}  // namespace stormproof::cli
