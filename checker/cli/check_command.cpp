// Reads the scenario, checks it, writes the counterexamples, prints the report.
#include "checker/cli/check_command.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "checker/cli/complain.hpp"
#include "checker/cli/counterexample_files.hpp"
#include "checker/cli/exit_code.hpp"
#include "checker/cli/report_files.hpp"
#include "checker/cli/run_monitor.hpp"
#include "checker/engines/smt/claims.hpp"
#include "checker/presentation/document/render.hpp"
#include "checker/presentation/json/dumped.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "checker/verification/check/check.hpp"
#include "checker/verification/check/check_report.hpp"
#include "model/config/provenance.hpp"
#include "model/config/tree/suggestion.hpp"

namespace stormproof::cli {

namespace {

using props::VerdictKind;

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

/// Proved 3, bounded 2, sampled 1, anything else 0.
int strength(VerdictKind kind) {
  switch (kind) {
    case VerdictKind::proved:
      return 3;
    case VerdictKind::bounded:
      return 2;
    case VerdictKind::sampled:
      return 1;
    case VerdictKind::violated:
    case VerdictKind::inconclusive:
      return 0;
  }
  return 0;
}

int required_strength(const std::string& require) {
  if (require == "proved") return 3;
  if (require == "bounded") return 2;
  return 1;
}

int exit_code(const checker::CheckReport& report, const std::string& require) {
  if (report.count(VerdictKind::violated) > 0) return violated;
  for (const checker::PropertyResult& result : report.results) {
    if (strength(result.verdict) < required_strength(require)) return inconclusive;
  }
  return report.interrupted ? inconclusive : established;
}

checker::CheckReport run_check(const CheckArguments& arguments, const model::Scenario& scenario) {
  smt::Options solver;
  solver.timeout =
      std::chrono::milliseconds{static_cast<std::int64_t>(arguments.timeout_seconds * 1000)};
  solver.seed = arguments.seed;
  solver.export_dir = arguments.export_directory;
  solver.second_solver = !arguments.single_solver;
  smt::Claims claims{solver};

  const InterruptGuard guard;
  StatusLine status{arguments.progress.value_or(isatty(STDERR_FILENO) != 0)};
  const auto on_progress = [&](std::string_view what) {
    if (status.due()) status.show(fmt::format("checking, {}: {:.0f} s", what, status.seconds()));
    return !InterruptGuard::interrupted();
  };
  const checker::CheckRequest request{scenario,          claims,     nullptr, arguments.seed,
                                      arguments.samples, on_progress};
  return checker::check({arguments.properties.begin(), arguments.properties.end()}, request);
}

std::string render(report::Format format, const checker::CheckReport& report,
                   const checker::CheckContext& context, bool verbose) {
  if (format == report::Format::json) return report::dumped(to_json(report, context));
  const report::Document document = document_of(report, context);
  switch (format) {
    case report::Format::markdown:
      return to_markdown(document);
    case report::Format::html:
      return to_html(document);
    case report::Format::junit:
      return to_junit(document);
    case report::Format::sarif:
      return report::dumped(to_sarif(document));
    case report::Format::json:
    case report::Format::text:
      break;
  }
  return to_text(document, {.verbose = verbose});
}

/// The command that gives the same verdicts.
std::string command_line(const CheckArguments& arguments) {
  std::string command = "stormproof check " + report::shell_word(arguments.scenario);
  for (const std::string& change : arguments.overrides)
    command += " --set " + report::shell_word(change);
  for (const std::string& id : arguments.properties) command += " --property " + id;
  if (!arguments.require.empty()) command += " --require " + arguments.require;
  if (arguments.seed != 0) command += fmt::format(" --seed {}", arguments.seed);
  if (arguments.samples != CheckArguments{}.samples) {
    command += fmt::format(" --samples {}", arguments.samples);
  }
  return command;
}

}  // namespace

int check(const CheckArguments& arguments) {
  const auto traced = model::config::trace_scenario(arguments.scenario, arguments.overrides,
                                                    model::config::SpecPath::standard());
  if (!traced) return complain(to_string(traced.error()));
  const auto reports = parse_report_files(arguments.reports);
  if (!reports) return complain(to_string(reports.error()));
  if (const auto error = unknown_property(arguments.properties)) return complain(*error);
  if (!arguments.export_directory.empty()) {
    std::error_code error;
    std::filesystem::create_directories(arguments.export_directory, error);
    if (error) {
      return complain(fmt::format("--export {}: cannot be created: {}", arguments.export_directory,
                                  error.message()));
    }
  }
  const checker::CheckReport report = run_check(arguments, traced->scenario);
  checker::CheckContext context{arguments.scenario, traced->scenario, {}, {}};
  context.places = traced->places;
  context.command = command_line(arguments);
  context.exit_code = exit_code(report, arguments.require);
  if (const auto error = write_counterexamples(arguments, report, context)) {
    return complain(*error);
  }
  const auto rendered = [&](report::Format format) {
    return render(format, report, context, arguments.verbose);
  };
  if (const auto error = write_report_files(*reports, rendered)) return complain(*error);
  fmt::print("{}", rendered(arguments.format));
  return context.exit_code;
}

}  // namespace stormproof::cli
