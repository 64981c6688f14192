// `stormproof tune SCENARIO`: reads the scenario, tunes it, writes the settings as the vendor's
// XML.
#include <fmt/core.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/durations.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/cli/tune_files.hpp"
#include "checker/engines/smt/claims.hpp"
#include "checker/experiments/tune/deploy.hpp"
#include "checker/experiments/tune/tune_report.hpp"
#include "checker/presentation/text/command_line.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "checker/verification/check/check.hpp"
#include "model/config/tree/quantities.hpp"

namespace stormproof::cli {

namespace {

using model::config::InputError;
using model::config::SpecPath;

struct TuneArguments {
  std::string scenario;
  std::vector<std::string> overrides;
  std::string preset;
  tune::Options options;
  std::string least = "2%";
  std::string start_jitter;  ///< empty: that of the scenario's `vary`
  std::string output;        ///< a folder, or one file that ends in ".xml"
  OutputFile svg;
  bool check = false;
};

/// What is wrong with the options, or nothing; `arguments.options` are then complete.
std::optional<std::string> complete(TuneArguments& arguments, const model::Scenario& scenario) {
  const auto least = model::config::parse_share(arguments.least);
  if (!least || least->value() >= 1) {
    return fmt::format(
        "--least-gain {}: expected a percentage, decimal or fraction of at least 0 "
        "and below 1, such as 2%",
        arguments.least);
  }
  arguments.options.least = least->value();
  const auto jitter = parse_start_jitter(arguments.start_jitter, scenario);
  if (!jitter) return jitter.error();
  arguments.options.start_jitter = *jitter;
  return std::nullopt;
}

/// The command that gives the numbers of a row again, from the written file.
std::string repeat_line(const TuneArguments& arguments, const tune::Subject& subject,
                        const tune::Report& report, const std::string& file) {
  std::string command = report::command_line({"simulate", arguments.scenario});
  for (const std::string& change : arguments.overrides) {
    if (!change.starts_with("dds=") && !change.starts_with("dds.")) {
      command += " --set " + report::shell_word(change);
    }
  }
  command += " --set " + report::shell_word("dds=" + tune::reference_to(file, subject));
  if (!report.is_sampled) return command;
  if (arguments.options.start_jitter.count() > 0) {
    command += " --start-jitter " + model::config::print_duration(arguments.options.start_jitter);
  }
  return command +
         fmt::format(" --samples {} --seed {}", report.compared.count, report.compared.first);
}

/// What the engines say about the recommended setting and not about the unchanged one; `broken` is
/// set if something newly is violated.
std::vector<std::string> check_lines(const tune::Report& report, bool& broken) {
  const auto check = [](const model::Scenario& scenario) {
    smt::Options solver;
    solver.interrupted = Session::interrupted;
    smt::Claims claims{solver};
    return checker::check({}, {scenario, claims, nullptr, 0, 12,
                               [](std::string_view) { return !Session::interrupted(); }});
  };
  const checker::CheckReport before = check(report.rows.front().scenario);
  const checker::CheckReport after = check(report.rows[*report.recommended].scenario);
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < after.results.size(); ++k) {
    const props::VerdictKind was = before.results[k].verdict;
    const props::VerdictKind is = after.results[k].verdict;
    if (was == is) continue;
    lines.push_back(
        fmt::format("{}: {} → {}", after.results[k].property->id, name_of(was), name_of(is)));
    broken = broken || is == props::VerdictKind::violated || is == props::VerdictKind::disputed;
  }
  if (before.interrupted || after.interrupted) {
    lines.emplace_back("interrupted");
  } else if (lines.empty()) {
    lines.emplace_back("every property of the catalogue has the verdict that it had unchanged");
  }
  return lines;
}

/// Refuses, before anything is searched, a profile that no file could say.
std::optional<InputError> refuse_unwritable(const tune::Subject& subject) {
  const auto xml = tune::deployable(subject, subject.scenario.dds, "", SpecPath::standard());
  if (xml) return std::nullopt;
  return xml.error();
}

/// What the report says around the study.
tune::Context context_of(const TuneArguments& arguments, const tune::Subject& subject,
                         const tune::Report& report, const TuneFiles& written) {
  tune::Context context{.scenario = arguments.scenario,
                        .overrides = arguments.overrides,
                        .subject = subject,
                        .options = arguments.options,
                        .files = written.files};
  context.files_wanted = !arguments.output.empty();
  if (report.answer != tune::Answer::better) return context;
  const tune::Row& best = report.rows[*report.recommended];
  context.prerequisites = tune::prerequisites(subject, best.scenario.dds);
  if (best.plan) {
    context.prerequisites.push_back(
        fmt::format("Start processes {}.", launch::words_of(*best.plan)));
    if (!written.launch.empty()) {
      context.prerequisites.back() +=
          fmt::format(" {} does, and others beside it for the other hosts or as systemd units.",
                      written.launch.front());
    }
  }
  if (const auto file = written.files.find(best.name); file != written.files.end()) {
    if (!best.plan) context.repeat = repeat_line(arguments, subject, report, file->second);
    context.loading = tune::how_to_load(subject.vendor, file->second);
  }
  if (arguments.check) context.check = check_lines(report, context.newly_violated);
  return context;
}

Outcome run(TuneArguments& arguments, Session& session) {
  const auto subject = tune::read_subject(arguments.scenario, arguments.overrides, arguments.preset,
                                          SpecPath::standard());
  if (!subject) return subject.error();
  if (const auto error = complete(arguments, subject->scenario)) return Complaint{*error};
  if (const auto error = refuse_unwritable(*subject)) return *error;
  TuneOutput output{arguments.output};
  if (const auto error = output.prepare()) return Complaint{*error};
  arguments.options.on_progress = session.on_study();
  arguments.options.time = Session::time();
  arguments.options.plans = true;
  const auto report = tune::tune(*subject, arguments.options);
  if (!report) return report.error();
  const std::string origin =
      fmt::format("stormproof tune on {} (seed {})", arguments.scenario, arguments.options.seed);
  const TuneFiles written = write_files(output, origin, arguments.scenario, *subject, *report);
  const tune::Context context = context_of(arguments, *subject, *report, written);
  Answer answer;
  if (written.error) answer.complaint = *written.error;
  answer.document = document_of(*report, context);
  answer.json = to_json(*report, context);
  if (report->rows.empty()) {
    arguments.svg.discard();
  } else if (arguments.svg.wanted()) {
    arguments.svg.stream() << to_svg(*report, context);
  }
  return answer;
}

void declare_study(Options& options, TuneArguments& arguments) {
  tune::Options& study = arguments.options;
  options.text("--preset", arguments.preset,
               "Tune this version of a library instead of the scenario's DDS profile", "NAME");
  options.number("--budget", study.budget, "Runs of the search (default 1200)", "N")
      .within(50, 10'000'000);
  options
      .number("--samples", study.samples,
              "Runs of each setting in the comparison, if they can differ (default 40)", "N")
      .within(6, 100'000);
  options.seed(study.seed, "Seed of the search and of the first schedule");
  options.texts("--keep", study.keep,
                "What every run must keep (repeatable; default: all that holds unchanged)", "ID");
  options.text("--least-gain", arguments.least,
               "What a change has to save to be worth making (default 2%)", "SHARE");
  options.start_jitter(arguments.start_jitter);
  options.jobs(study.threads);
}

void declare(Options& options, TuneArguments& arguments) {
  options.scenario(arguments.scenario, arguments.overrides);
  declare_study(options, arguments);
  options
      .written("-o,--output", arguments.output,
               "Write the recommended setting and the front as vendor XML: a folder, or FILE.xml",
               "DIR|FILE.xml")
      .not_repeated();
  options.svg(arguments.svg, "Plot completion against messages");
  options.flag("--check", arguments.check, "Also ask every engine about the recommended setting");
}

}  // namespace

void declare_tune(Frame& frame) {
  frame.add<TuneArguments>(
      {"tune",
       "Search the settings that a user can change for the shortest discovery",
       "Exit code: 0 something better was found, or nothing better exists (the output says "
       "which),\n"
       "1 with --check a property is newly violated, 2 bad input, 3 interrupted.",
       Formats::pages,
       {tune::json_schema}},
      declare, run);
}

}  // namespace stormproof::cli
