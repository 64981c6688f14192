// `stormproof fix SCENARIO`: what makes this deployment discover itself in time, and the files to
// deploy it.
#include <algorithm>

#include "checker/cli/commands.hpp"
#include "checker/cli/durations.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/output_folder.hpp"
#include "checker/experiments/fix/fix_report.hpp"
#include "model/config/scenario_file.hpp"
#include "props/applicability.hpp"

namespace stormproof::cli {

namespace {

struct FixArguments {
  fix::Request request;
  std::vector<std::string> keep;
  std::string start_jitter;  ///< empty: that of the scenario, or 10 ms if nothing is drawn
  std::string folder;        ///< of the files to deploy; empty: none
};

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (const fix::Kind kind : fix::kinds) names.emplace_back(name_of(kind));
  return names;
}

/// What is wrong with the options, or nothing; the request is complete then.
std::optional<Complaint> complete(FixArguments& arguments, const model::config::SpecPath& specs) {
  constexpr model::Nanoseconds usual_jitter{10'000'000};
  fix::Request& request = arguments.request;
  const auto scenario = model::config::read_scenario(request.scenario, request.overrides, specs);
  if (!scenario) return scenario.error();
  if (const auto why = props::why_profile_is_not_changed(*scenario); !why.empty()) {
    return model::config::InputError{request.scenario, std::string{why}};
  }
  const auto jitter = parse_start_jitter(arguments.start_jitter, *scenario);
  if (!jitter) return Complaint{jitter.error()};
  request.start_jitter = *jitter;
  if (arguments.start_jitter.empty() && jitter->count() == 0 && !model::is_drawn(*scenario)) {
    request.start_jitter = usual_jitter;
  }
  for (const fix::Kind kind : fix::kinds) {
    if (std::ranges::find(arguments.keep, name_of(kind)) != arguments.keep.end()) {
      request.keep.insert(kind);
    }
  }
  if (request.keep.size() == std::size(fix::kinds)) {
    return Complaint{"--keep: nothing is left to change; expected one of the four kinds less"};
  }
  return std::nullopt;
}

/// Writes what the chosen attempt takes, and notes it.
std::optional<Complaint> write_files(OutputFolder& folder, const FixArguments& arguments,
                                     const fix::Report& report, fix::Context& context,
                                     const model::config::SpecPath& specs) {
  if (!report.chosen || report.interrupted) return std::nullopt;
  const auto files = fix::files_of(report.attempts[*report.chosen], arguments.request, specs);
  if (!files) return Complaint{files.error()};
  for (const compare::DeploymentFile& file : *files) {
    if (const auto path = folder.write(file.name, file.text)) context.written.push_back(*path);
  }
  context.loading = fix::how_to_load(*files, arguments.folder);
  return std::nullopt;
}

Outcome run(FixArguments& arguments, Session& session) {
  const auto specs = model::config::SpecPath::standard();
  fix::Request& request = arguments.request;
  if (auto complaint = complete(arguments, specs)) return *std::move(complaint);
  std::optional<OutputFolder> folder;
  if (!arguments.folder.empty()) {
    folder.emplace("--export", arguments.folder, "fix", std::vector{request.scenario});
    if (const auto error = folder->prepare()) return Complaint{*error};
  }
  request.on_progress = session.on_study();
  request.time = Session::time();
  const auto report = fix::fix(request, specs);
  if (!report) return report.error();
  fix::Context context;
  Answer answer;
  if (folder) {
    if (auto complaint = write_files(*folder, arguments, *report, context, specs)) {
      return *std::move(complaint);
    }
    answer.complaint = folder->error().value_or("");
  }
  answer.document = document_of(*report, request, context);
  answer.json = to_json(*report, request, context);
  return answer;
}

void declare(Options& options, FixArguments& arguments) {
  fix::Request& request = arguments.request;
  options.scenario(request.scenario, request.overrides);
  options
      .texts("--keep", arguments.keep,
             "Do not change this: settings, discovery, launch or vendor (repeatable)", "KIND")
      .one_of(kind_names());
  options.number("--samples", request.samples, "Runs before and after (default 12)", "N")
      .within(2, 100'000);
  options.number("--budget", request.budget, "Runs of the search for settings (default 200)", "N")
      .within(50, 1'000'000);
  options.seed(request.seed, "Seed of the first run (default 0)");
  options.start_jitter(arguments.start_jitter);
  options.folder("--export", arguments.folder, "Write the files to deploy here");
  options.jobs(request.threads);
}

}  // namespace

void declare_fix(Frame& frame) {
  frame.add<FixArguments>(
      {"fix",
       "What makes this deployment discover itself in time, and the files to deploy it",
       "Exit code: 0 nothing to fix, or cured; 1 nothing that was tried cures it; 3 interrupted,\n"
       "2 bad input.",
       Formats::pages,
       {fix::json_schema}},
      declare, run);
}

}  // namespace stormproof::cli
