// `stormproof diff BASE CANDIDATE`: what a change of a DDS profile does to discovery. With
// --exhibit the change is that of an exhibit of the museum.
#include <fmt/core.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/diff_exhibit.hpp"
#include "checker/cli/diff_files.hpp"
#include "checker/cli/frame.hpp"
#include "checker/experiments/diff/diff_report.hpp"
#include "checker/presentation/text/command_line.hpp"

namespace stormproof::cli {

namespace {

struct DiffArguments {
  std::string base, candidate;
  std::string exhibit;
  std::vector<std::string> overrides;  ///< of both profiles
  std::string grid;
  std::string scenario;
  std::string policy = "default";
  std::optional<std::size_t> samples;
  std::optional<std::uint64_t> seed;
  bool no_check = false;
  bool rolling = false;
  bool no_telling_apart = false;
  std::string directory;  ///< empty: the usual one
  std::size_t jobs = 0;
};

/// What is wrong with what is given to be compared; empty if nothing is.
std::string wrong_sides(const DiffArguments& arguments) {
  if (arguments.exhibit.empty()) {
    if (arguments.base.empty()) return "missing BASE and CANDIDATE; expected two DDS profiles";
    if (arguments.candidate.empty()) return "missing CANDIDATE; expected a second DDS profile";
    return "";
  }
  if (arguments.candidate.empty()) return "";
  return "CANDIDATE: with --exhibit there is none; expected at most the profile that its knobs are "
         "changed in";
}

/// Puts the two profiles into the request.
std::optional<model::config::InputError> read_sides(const DiffArguments& arguments,
                                                    const model::config::SpecPath& specs,
                                                    diff::DiffRequest& request) {
  const auto base = model::config::trace_dds_profile(arguments.base, arguments.overrides, specs);
  if (!base) return base.error();
  const auto candidate =
      model::config::trace_dds_profile(arguments.candidate, arguments.overrides, specs);
  if (!candidate) return candidate.error();
  request.base = *base;
  request.candidate = *candidate;
  return std::nullopt;
}

/// What is compared, from the command line; the error if something in it is wrong.
model::config::Result<diff::DiffRequest> request_of(const DiffArguments& arguments,
                                                    const std::optional<ExhibitSides>& exhibit,
                                                    const model::config::SpecPath& specs,
                                                    Session& session) {
  diff::DiffRequest request;
  if (exhibit) {
    request.base = exhibit->before;
    request.candidate = exhibit->after;
  } else if (const auto error = read_sides(arguments, specs, request)) {
    return *error;
  }
  const auto policy = diff::read_policy(arguments.policy, specs);
  if (!policy) return policy.error();
  request.policy = *policy;
  request.grid = arguments.grid;
  request.scenario = arguments.scenario;
  request.samples = arguments.samples;
  request.seed = arguments.seed;
  request.check_verdicts = !arguments.no_check;
  request.tell_apart = !arguments.no_telling_apart;
  request.rolling = arguments.rolling;
  request.threads = arguments.jobs;
  request.time = Session::time();
  request.on_progress = session.on_study();
  request.interrupted = Session::interrupted;
  return request;
}

Outcome run(DiffArguments& arguments, Session& session) {
  const model::config::SpecPath specs = model::config::SpecPath::standard();
  if (const std::string wrong = wrong_sides(arguments); !wrong.empty()) return Complaint{wrong};
  std::optional<ExhibitSides> exhibit;
  if (!arguments.exhibit.empty()) {
    const auto& over = arguments.scenario.empty() ? arguments.grid : arguments.scenario;
    auto sides = sides_of(arguments.exhibit, arguments.base, arguments.overrides, over, specs);
    if (!sides) return sides.error();
    exhibit = *std::move(sides);
  }
  const auto request = request_of(arguments, exhibit, specs, session);
  if (!request) return request.error();
  std::vector<std::string> sides{arguments.base, arguments.candidate};
  if (exhibit) sides = {exhibit->exhibit.id};
  OutputFolder folder{"--output", arguments.directory, "diff", sides};
  if (const auto error = folder.prepare()) return Complaint{*error};
  const auto report = diff::diff(*request, specs);
  if (!report) return report.error();
  diff::Files files;
  Answer answer;
  write_diff_files(folder, *report, files);
  answer.complaint = folder.error().value_or("");
  answer.listing = folder.listing();
  answer.document = document_of(*report, files);
  answer.json = to_json(*report, files);
  answer.document.next = {{report::command_line({"profile", "show", arguments.candidate}),
                           "which of its values a user can set"}};
  if (exhibit) {
    answer.document.title = "stormproof diff --exhibit " + exhibit->exhibit.id;
    answer.document.answer =
        reach_of(exhibit->exhibit, *report) + ". " + std::string{answer.document.answer.plain()};
    answer.document.next = {
        {report::command_line({"museum", exhibit->exhibit.id}), "the story of the exhibit"}};
  }
  return answer;
}

void declare(Options& options, DiffArguments& arguments) {
  options.text("base", arguments.base, "DDS profile before the change: name, file or XML", "BASE");
  options.text("candidate", arguments.candidate, "DDS profile after it", "CANDIDATE");
  options.text(
      "--exhibit", arguments.exhibit,
      "Instead of two profiles: the knobs of an exhibit of the museum before and after its "
      "repair, in BASE if that is given",
      "ID");
  options.overrides(arguments.overrides, "both profiles");
  options.text("--over", arguments.grid,
               "Grid of deployments, or one scenario, to compare over (default: review)", "GRID");
  options.flag("--rolling", arguments.rolling,
               "Hosts get the candidate one by one: every fleet between, worst and best order");
  options.text("--scenario", arguments.scenario,
               "Scenario whose verdicts are compared (default: the least one of the grid)",
               "SCENARIO");
  options.text("--policy", arguments.policy,
               "What counts as a regression: name or file (default: default)", "POLICY");
  options
      .number("--samples", arguments.samples,
              "Schedules of each configuration (default: those of the policy, which grow)", "N")
      .within(1, 100'000);
  options.number("--seed", arguments.seed, "Seed of the first schedule (default 0)", "S");
  options.flag("--no-check", arguments.no_check, "Do not compare the verdicts of properties");
  options.flag("--no-telling-apart", arguments.no_telling_apart,
               "Do not look for the smallest scenario that tells the profiles apart");
  options.jobs(arguments.jobs);
  options.folder("-o,--output", arguments.directory,
                 usual_folder_help("Where runs, charts and counterexamples are written",
                                   "diff-BASE-CANDIDATE"));
}

}  // namespace

void declare_diff(Frame& frame) {
  frame.add<DiffArguments>(
      {"diff",
       "What a change of a DDS profile does: knobs, verdicts, costs, least difference",
       "Exit code: 0 no regression, 1 a regression by the policy, 3 inconclusive or interrupted,\n"
       "2 bad input.",
       Formats::review,
       {diff::json_schema}},
      declare, run);
}

}  // namespace stormproof::cli
