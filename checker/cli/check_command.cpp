// `stormproof check SCENARIO`: reads the scenario, checks it, writes the counterexamples.
#include <algorithm>

#include <fmt/core.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/counterexample_files.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/engines/smt/claims.hpp"
#include "checker/verification/check/check.hpp"
#include "checker/verification/check/check_report.hpp"
#include "checker/verification/counterexample/gtest_case.hpp"
#include "model/config/scenario_file.hpp"
#include "model/config/tree/suggestion.hpp"

namespace stormproof::cli {

namespace {

using props::VerdictKind;

struct CheckArguments {
  std::string scenario;                        ///< file, or name of a shipped scenario
  std::vector<std::string> overrides;          ///< key.path=value
  std::vector<std::string> properties;         ///< ids; empty: the whole catalogue
  VerdictKind require = VerdictKind::sampled;  ///< the weakest verdict that is accepted
  double timeout_seconds = 10;                 ///< of each query, for each solver
  std::string export_directory;                ///< for SMT-LIB 2 files; empty: none
  std::string counterexamples = "counterexamples";
  OutputFile emit_test;
  unsigned seed = 0;
  std::uint32_t samples = 12;
  bool single_solver = false;
};

/// What is wrong with the ids on the command line, or nothing.
std::optional<std::string> unknown_property(const std::vector<std::string>& ids) {
  std::vector<std::string> known;
  for (const props::Property& property : props::catalogue()) known.emplace_back(property.id);
  for (const std::string& id : ids) {
    if (std::ranges::find(known, id) != known.end()) continue;
    return fmt::format("--property {}: no such property{}; 'stormproof properties' lists them", id,
                       model::config::suggestion(id, known));
  }
  return std::nullopt;
}

ExitCode exit_code(const checker::CheckReport& report, VerdictKind require) {
  if (report.count(VerdictKind::violated) > 0) return violated;
  // Kinds are in the order of their strength.
  const auto too_weak = [&](const auto& result) { return result.verdict > require; };
  const bool weak = std::ranges::any_of(report.results, too_weak);
  return weak || report.interrupted ? inconclusive : established;
}

checker::CheckReport run_check(const CheckArguments& arguments, const model::Scenario& scenario,
                               Session& session) {
  smt::Options solver;
  solver.timeout =
      std::chrono::milliseconds{static_cast<std::int64_t>(arguments.timeout_seconds * 1000)};
  solver.seed = arguments.seed;
  solver.export_dir = arguments.export_directory;
  solver.second_solver = !arguments.single_solver;
  smt::Claims claims{solver};
  return checker::check({arguments.properties.begin(), arguments.properties.end()},
                        {scenario, claims, nullptr, arguments.seed, arguments.samples,
                         session.on_steps("checking, ")});
}

Outcome run(CheckArguments& arguments, Session& session) {
  const auto traced = model::config::trace_scenario(arguments.scenario, arguments.overrides,
                                                    model::config::SpecPath::standard());
  if (!traced) return traced.error();
  if (const auto error = unknown_property(arguments.properties)) return Complaint{*error};
  if (!arguments.export_directory.empty()) {
    const auto error = make_folder("--export", arguments.export_directory);
    if (error) return Complaint{*error};
  }
  const checker::CheckReport report = run_check(arguments, traced->value, session);
  checker::CheckContext context{traced->reference,
                                traced->value,
                                {},
                                {},
                                traced->places,
                                exit_code(report, arguments.require)};
  Answer answer;
  if (const auto error = write_counterexamples(arguments.counterexamples, report, context)) {
    answer.complaint = *error;
  }
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
  options.choice("--require", arguments.require,
                 {{"proved", VerdictKind::proved},
                  {"bounded", VerdictKind::bounded},
                  {"sampled", VerdictKind::sampled}},
                 "Accept only verdicts of at least this kind: proved, bounded or sampled", "KIND");
  options.timeout(arguments.timeout_seconds);
  options.folder("--counterexamples", arguments.counterexamples,
                 "Where counterexamples are written (default: counterexamples/)");
  options.output("--emit-test", arguments.emit_test,
                 "Write the counterexamples as GoogleTest cases");
  options.folder("--export", arguments.export_directory,
                 "Write the queries in SMT-LIB 2, one file for each property");
  options.flag("--single-solver", arguments.single_solver, "Do not ask cvc5 for a second opinion");
  options.number("--seed", arguments.seed, "Seed of solvers and of drawn schedules", "S");
  options
      .number("--samples", arguments.samples,
              "Runs of a scenario whose schedule is drawn (default 12)", "N")
      .within(1, 1'000'000);
}

}  // namespace

void declare_check(Frame& frame) {
  frame.add<CheckArguments>(
      {"check", "Which properties hold for a scenario: proofs, exploration, counterexamples",
       "Exit code: 0 everything holds, 1 a property is violated, 3 a verdict is inconclusive or\n"
       "weaker than --require, 2 bad input.",
       Formats::findings},
      declare, run);
}

}  // namespace stormproof::cli
