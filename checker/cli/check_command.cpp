// `stormproof check SCENARIO`: reads the scenario, checks it, writes the counterexamples.
#include <algorithm>
#include <filesystem>

#include <fmt/core.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/counterexample_files.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/engines/explorer/scope.hpp"
#include "checker/engines/smt/claims.hpp"
#include "checker/verification/check/baseline.hpp"
#include "checker/verification/check/check.hpp"
#include "checker/verification/check/check_report.hpp"
#include "checker/verification/check/next_steps.hpp"
#include "checker/verification/counterexample/gtest_case.hpp"
#include "model/config/scenario_file.hpp"
#include "model/config/tree/suggestion.hpp"
#include "props/limits.hpp"

namespace stormproof::cli {

namespace {

using props::VerdictKind;

struct CheckArguments {
  std::string scenario;                 ///< file, or name of a shipped scenario
  std::vector<std::string> overrides;   ///< key.path=value
  std::vector<std::string> properties;  ///< ids; empty: the whole catalogue
  checker::GateRules rules;
  std::string baseline;  ///< file; empty: none
  bool update_baseline = false;
  bool thorough = false;
  double timeout_seconds = 120;  ///< of each query, for each solver
  std::string export_directory;  ///< for SMT-LIB 2 files; empty: none
  std::string counterexamples;   ///< a folder; empty: the usual one
  OutputFile emit_test;
  unsigned seed = 0;
  std::uint32_t samples = 12;
  std::uint32_t readers = 1;  ///< of one writer that the explorer looks at together, at most
  bool single_solver = false;
  bool frontier = false;
};

/// What is wrong with the ids on the command line, or nothing.
std::optional<std::string> unknown_property(const std::vector<std::string>& ids,
                                            const model::Scenario& scenario) {
  std::vector<std::string> known;
  for (const props::Property& property : props::catalogue()) known.emplace_back(property.id);
  for (const std::string_view limit : props::limits_of(scenario)) known.emplace_back(limit);
  for (const std::string& id : ids) {
    if (std::ranges::find(known, id) != known.end()) continue;
    return fmt::format("--property {}: no such property{}; 'stormproof properties' lists them", id,
                       model::config::suggestion(id, known));
  }
  return std::nullopt;
}

/// The baseline of the command line; empty if there is none, or none yet that is to be written.
model::config::Result<checker::Baseline> baseline_of(const CheckArguments& arguments) {
  const std::string& path = arguments.baseline;
  if (path.empty() || (arguments.update_baseline && !std::filesystem::exists(path))) {
    return checker::Baseline{};
  }
  return checker::read_baseline(path);
}

/// Writes what fails as accepted, beside what the file accepts of other scenarios. The reason if
/// that cannot be done.
std::optional<std::string> update_baseline(const CheckArguments& arguments,
                                           checker::Baseline baseline, bool interrupted,
                                           checker::Gate& gate, const checker::CheckReport& report,
                                           const model::DdsProfile& dds) {
  if (interrupted) return arguments.baseline + ": not written, because the check was interrupted";
  std::vector<checker::Failure>& accepted = baseline[arguments.scenario];
  accepted = gate.failures;
  OutputFile file;
  file.open(arguments.baseline, "--baseline " + arguments.baseline);
  if (auto error = file.open_error()) return error;
  file.stream() << baseline_text(baseline);
  if (auto error = file.commit()) return error;
  checker::GateRules rules = gate.rules;
  rules.baseline = accepted;
  gate = judge(report, dds, std::move(rules));
  return std::nullopt;
}

checker::CheckReport run_check(const CheckArguments& arguments, const model::Scenario& scenario,
                               Session& session, Answer& answer) {
  smt::Options solver;
  solver.timeout =
      std::chrono::milliseconds{static_cast<std::int64_t>(arguments.timeout_seconds * 1000)};
  if (arguments.thorough) solver.budget = solver.budget.times(checker::thorough);
  solver.seed = arguments.seed;
  solver.export_dir = arguments.export_directory;
  solver.second_solver = !arguments.single_solver;
  solver.interrupted = Session::interrupted;
  smt::Claims claims{solver};
  checker::CheckReport report =
      checker::check({arguments.properties.begin(), arguments.properties.end()},
                     {scenario,
                      claims,
                      nullptr,
                      arguments.seed,
                      arguments.samples,
                      session.on_steps("checking, "),
                      arguments.readers,
                      {},
                      arguments.thorough ? checker::thorough : 1U});
  if (arguments.frontier) report.frontiers = calculus::frontier_of(scenario);
  if (const auto error = claims.export_error()) answer.complaint = "--export: " + *error;
  return report;
}

Outcome run(CheckArguments& arguments, Session& session) {
  const auto traced = model::config::trace_scenario(arguments.scenario, arguments.overrides,
                                                    model::config::SpecPath::standard());
  if (!traced) return traced.error();
  if (const auto error = unknown_property(arguments.properties, traced->value)) {
    return Complaint{*error};
  }
  const auto baseline = baseline_of(arguments);
  if (!baseline) return baseline.error();
  if (!arguments.export_directory.empty()) {
    const auto error = make_folder("--export", arguments.export_directory);
    if (error) return Complaint{*error};
  }
  OutputFolder folder{
      "--counterexamples", arguments.counterexamples, "check", {arguments.scenario}};
  if (const auto error = folder.prepare()) return Complaint{*error};
  Answer answer;
  const checker::CheckReport report = run_check(arguments, traced->value, session, answer);
  if (const auto known = baseline->find(arguments.scenario); known != baseline->end()) {
    arguments.rules.baseline = known->second;
  }
  const model::DdsProfile& dds = traced->value.dds;
  checker::Gate gate = judge(report, dds, arguments.rules);
  if (arguments.update_baseline) {
    const auto error = update_baseline(arguments, *baseline, report.interrupted, gate, report, dds);
    if (error) answer.complaint = *error;
  }
  checker::CheckContext context{traced->reference,
                                traced->value,
                                {},
                                {},
                                traced->places,
                                std::move(gate),
                                checker::words_of(arguments.scenario, arguments.overrides)};
  write_counterexamples(folder, report, context);
  if (folder.error()) answer.complaint = *folder.error();
  answer.listing = folder.listing();
  if (arguments.emit_test.wanted()) {
    std::vector<props::Counterexample> all;
    for (const checker::PropertyResult& result : report.results) {
      if (const auto* found = result.counterexample()) all.push_back(*found);
    }
    arguments.emit_test.stream() << counterexample::gtest_file(all, session.command());
  }
  answer.document = document_of(report, context);
  answer.json = to_json(report, context);
  return answer;
}

void declare(Options& options, CheckArguments& arguments) {
  options.scenario(arguments.scenario, arguments.overrides);
  options.texts("--property", arguments.properties,
                "Check only this property (repeatable); 'stormproof properties' lists them", "ID");
  options.choice("--require", arguments.rules.require,
                 {{"proved", VerdictKind::proved},
                  {"bounded", VerdictKind::bounded},
                  {"sampled", VerdictKind::sampled},
                  {"observed", VerdictKind::observed}},
                 "Accept what the rules promise only if it is at least proved, bounded, sampled or "
                 "observed",
                 "KIND");
  options.flag("--strict", arguments.rules.strict,
               "Fail, too, where other delays or losses could break what the rules do not promise");
  const Option baseline = options.text(
      "--baseline", arguments.baseline,
      "Accept the failures that this file lists for the scenario; fail on anything new", "FILE");
  options
      .flag("--update-baseline", arguments.update_baseline,
            "Write what fails now into the baseline")
      .needs(baseline);
  options.flag("--thorough", arguments.thorough,
               "Search longer: more states of the explorer, more resources of the solvers");
  options.timeout(arguments.timeout_seconds);
  options.folder("--counterexamples", arguments.counterexamples,
                 usual_folder_help("Where counterexamples are written", "check-SCENARIO"));
  options.output("--emit-test", arguments.emit_test,
                 "Write the counterexamples as GoogleTest cases");
  options.folder("--export", arguments.export_directory,
                 "Write the queries in SMT-LIB 2, one file for each property");
  options.flag("--frontier", arguments.frontier,
               "Say, too, up to which load storm.cannot-start is proved");
  options.flag("--single-solver", arguments.single_solver, "Do not ask cvc5 for a second opinion");
  options.number("--seed", arguments.seed, "Seed of solvers and of drawn schedules", "S");
  options
      .number("--samples", arguments.samples,
              "Runs of a scenario whose schedule is drawn (default 12)", "N")
      .within(1, 1'000'000);
  options
      .number("--readers", arguments.readers,
              "Let the explorer look at several readers of one writer, 2 or 3, and at both writers "
              "of a participant, too (default 1)",
              "N")
      .within(1U, explorer::most_readers);
}

}  // namespace

void declare_check(Frame& frame) {
  frame.add<CheckArguments>(
      {"check",
       "Whether discovery works in a scenario: runs, proofs, exploration, counterexamples",
       "Exit code: 0 discovery completes within its limits and without a storm, nothing is "
       "violated\n"
       "in this deployment, and what the rules promise is established; 1 something of that fails;\n"
       "3 something promised is inconclusive or weaker than --require, or answers contradict each\n"
       "other (disputed); 2 bad input.",
       Formats::findings,
       {checker::check_schema}},
      declare, run);
}

}  // namespace stormproof::cli
