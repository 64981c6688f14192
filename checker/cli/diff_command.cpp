// `stormproof diff BASE CANDIDATE`: what a change of a DDS profile does to discovery.
#include <fmt/core.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/diff_files.hpp"
#include "checker/cli/frame.hpp"
#include "checker/experiments/diff/diff_report.hpp"
#include "checker/presentation/text/command_line.hpp"

namespace stormproof::cli {

namespace {

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
  std::string directory;  ///< empty: the usual one
  std::size_t jobs = 0;
};

/// What is compared, from the command line; the error if something in it is wrong.
model::config::Result<diff::DiffRequest> request_of(const DiffArguments& arguments,
                                                    const model::config::SpecPath& specs,
                                                    Session& session) {
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
  request.on_progress = session.on_steps();
  request.interrupted = Session::interrupted;
  return request;
}

Outcome run(DiffArguments& arguments, Session& session) {
  const model::config::SpecPath specs = model::config::SpecPath::standard();
  const auto request = request_of(arguments, specs, session);
  if (!request) return request.error();
  OutputFolder folder{
      "--output", arguments.directory, "diff", {arguments.base, arguments.candidate}};
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
  return answer;
}

void declare(Options& options, DiffArguments& arguments) {
  options.text("base", arguments.base, "DDS profile before the change: name, file or XML", "BASE")
      .required();
  options.text("candidate", arguments.candidate, "DDS profile after it", "CANDIDATE").required();
  options.overrides(arguments.overrides, "both profiles");
  options.text("--over", arguments.grid,
               "Grid of deployments, or one scenario, to compare over (default: review)", "GRID");
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
       Formats::findings,
       {diff::json_schema}},
      declare, run);
}

}  // namespace stormproof::cli
