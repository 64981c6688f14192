// Reads the scenario, tunes it, writes the settings as the vendor's XML, prints the report.
#include "checker/cli/tune_command.hpp"

#include <memory>

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "checker/cli/complain.hpp"
#include "checker/cli/exit_code.hpp"
#include "checker/cli/options.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/cli/run_monitor.hpp"
#include "checker/cli/tune_files.hpp"
#include "checker/engines/smt/claims.hpp"
#include "checker/experiments/tune/deploy.hpp"
#include "checker/experiments/tune/tune_report.hpp"
#include "checker/presentation/document/render.hpp"
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
  std::string svg_file;
  bool check = false;
  bool json = false;
  std::optional<bool> progress;
};

/// "2%", "0.02" or "1/50"; nothing if it is none of these, or more than 1.
std::optional<double> parse_share(std::string text) {
  if (text == "0" || text == "0%") return 0;
  const bool is_percent = text.ends_with('%');
  if (is_percent) text.pop_back();
  const auto fraction = model::config::parse_fraction(text);
  if (!fraction) return std::nullopt;
  const double share = static_cast<double>(fraction->numerator) /
                       static_cast<double>(fraction->denominator) / (is_percent ? 100 : 1);
  if (share < 0 || share >= 1) return std::nullopt;
  return share;
}

/// What is wrong with the options, or nothing; `arguments.options` are then complete.
std::optional<std::string> complete(TuneArguments& arguments, const model::Scenario& scenario) {
  const auto least = parse_share(arguments.least);
  if (!least) {
    return fmt::format(
        "--least-gain {}: expected a percentage, decimal or fraction of at least 0 "
        "and below 1, such as 2%",
        arguments.least);
  }
  arguments.options.least = *least;
  if (!arguments.start_jitter.empty()) {
    const auto jitter = model::config::parse_duration(arguments.start_jitter);
    constexpr model::Nanoseconds longest{1'000'000'000'000};
    if (!jitter) return fmt::format("--start-jitter: {}", jitter.error());
    if (*jitter > longest) {
      return fmt::format("--start-jitter {}: expected at most 1000s", arguments.start_jitter);
    }
    arguments.options.start_jitter = *jitter;
  } else if (scenario.vary && scenario.vary->start_jitter) {
    arguments.options.start_jitter = *scenario.vary->start_jitter;
  }
  return std::nullopt;
}

std::string command_line(const TuneArguments& arguments) {
  const tune::Options& options = arguments.options;
  std::string command = "stormproof tune " + report::shell_word(arguments.scenario);
  for (const std::string& change : arguments.overrides) {
    command += " --set " + report::shell_word(change);
  }
  if (!arguments.preset.empty()) command += " --preset " + arguments.preset;
  command += fmt::format(" --budget {} --samples {} --seed {}", options.budget, options.samples,
                         options.seed);
  for (const std::string& id : options.keep) command += " --keep " + id;
  if (arguments.least != "2%") command += " --least-gain " + arguments.least;
  if (options.start_jitter.count() > 0) {
    command += " --start-jitter " + model::config::print_duration(options.start_jitter);
  }
  return command;
}

/// The command that gives the numbers of a row again, from the written file.
std::string repeat_line(const TuneArguments& arguments, const tune::Subject& subject,
                        const tune::Report& report, const std::string& file) {
  if (arguments.options.start_jitter.count() > 0) return {};  // `simulate` has none
  std::string command = "stormproof simulate " + report::shell_word(arguments.scenario);
  for (const std::string& change : arguments.overrides) {
    if (!change.starts_with("dds=") && !change.starts_with("dds.")) {
      command += " --set " + report::shell_word(change);
    }
  }
  command += " --set " + report::shell_word("dds=" + tune::reference_to(file, subject));
  if (!report.is_sampled) return command;
  return command +
         fmt::format(" --samples {} --seed {}", report.compared.count, report.compared.first);
}

/// What the engines say about the recommended setting and not about the unchanged one; `broken` is
/// set if something newly is violated.
std::vector<std::string> check_lines(const tune::Report& report, bool& broken) {
  const auto check = [](const model::Scenario& scenario) {
    smt::Claims claims{smt::Options{}};
    return checker::check({}, {scenario, claims, nullptr, 0, 12,
                               [](std::string_view) { return !InterruptGuard::interrupted(); }});
  };
  const InterruptGuard guard;
  const checker::CheckReport before = check(report.rows.front().scenario);
  const checker::CheckReport after = check(report.rows[*report.recommended].scenario);
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < after.results.size(); ++k) {
    const props::VerdictKind was = before.results[k].verdict;
    const props::VerdictKind is = after.results[k].verdict;
    if (was == is) continue;
    lines.push_back(
        fmt::format("{}: {} → {}", after.results[k].property->id, name_of(was), name_of(is)));
    broken = broken || is == props::VerdictKind::violated;
  }
  if (before.interrupted || after.interrupted) {
    lines.emplace_back("interrupted");
  } else if (lines.empty()) {
    lines.emplace_back("every property of the catalogue has the verdict that it had unchanged");
  }
  return lines;
}

model::config::Result<tune::Report> run_tune(TuneArguments& arguments,
                                             const tune::Subject& subject) {
  const InterruptGuard guard;
  StatusLine line{arguments.progress.value_or(isatty(STDERR_FILENO) != 0)};
  arguments.options.on_progress = [&line](std::string_view doing, std::size_t runs,
                                          std::size_t about) {
    if (line.due()) line.show(fmt::format("{}: {} of about {} runs", doing, runs, about));
    return !InterruptGuard::interrupted();
  };
  return tune::tune(subject, arguments.options);
}

/// Refuses, before anything is searched, a profile that no file could say.
std::optional<InputError> refuse_unwritable(const tune::Subject& subject) {
  const auto xml = tune::deployable(subject, subject.scenario.dds, "", SpecPath::standard());
  if (xml) return std::nullopt;
  return xml.error();
}

int tune_scenario(TuneArguments& arguments) {
  const auto subject = tune::read_subject(arguments.scenario, arguments.overrides, arguments.preset,
                                          SpecPath::standard());
  if (!subject) return complain(to_string(subject.error()));
  if (const auto error = complete(arguments, subject->scenario)) return complain(*error);
  if (const auto error = refuse_unwritable(*subject)) return complain(to_string(*error));
  if (const auto error = refuse_output(arguments.output)) return complain(*error);
  OutputFile svg{arguments.svg_file};
  if (const auto error = svg.open_error()) return complain(*error);

  const auto report = run_tune(arguments, *subject);
  if (!report) return complain(to_string(report.error()));
  const TuneFiles written = write_files(
      {arguments.output, arguments.scenario, arguments.options.seed}, *subject, *report);
  if (written.error) return complain(to_string(*written.error));

  tune::Context context{arguments.scenario,
                        command_line(arguments),
                        *subject,
                        arguments.options,
                        written.files,
                        {},
                        {},
                        {}};
  context.files_wanted = !arguments.output.empty();
  if (report->answer == tune::Answer::better) {
    const tune::Row& best = report->rows[*report->recommended];
    context.prerequisites = tune::prerequisites(*subject, best.scenario.dds);
    if (const auto file = written.files.find(best.name); file != written.files.end()) {
      context.repeat = repeat_line(arguments, *subject, *report, file->second);
    }
    if (arguments.check) context.check = check_lines(*report, context.newly_violated);
  }
  fmt::print("{}", arguments.json ? to_json(*report, context).dump(2) + "\n"
                                  : report::to_text(document_of(*report, context)));
  if (svg.wanted() && !report->rows.empty()) {
    svg.stream() << to_svg(*report, context);
    if (const auto error = svg.commit()) return complain(*error);
  }
  if (report->answer == tune::Answer::interrupted) return inconclusive;
  return context.newly_violated ? violated : established;
}

void add_study_options(CLI::App& command, TuneArguments& arguments) {
  tune::Options& options = arguments.options;
  command
      .add_option("--preset", arguments.preset,
                  "Tune this version of a library instead of the scenario's DDS profile")
      ->type_name("NAME");
  command.add_option("--budget", options.budget, "Runs of the search (default 1200)")
      ->check(CLI::Range(50, 10'000'000))
      ->type_name("N");
  command
      .add_option("--samples", options.samples,
                  "Runs of each setting in the comparison, if they can differ (default 40)")
      ->check(CLI::Range(6, 100'000))
      ->type_name("N");
  command.add_option("--seed", options.seed, "Seed of the search and of the first schedule")
      ->type_name("S");
  add_repeatable(command, "--keep", options.keep,
                 "What every run must keep (repeatable; default: all that holds unchanged)")
      ->type_name("ID");
  command
      .add_option("--least-gain", arguments.least,
                  "What a change has to save to be worth making (default 2%)")
      ->type_name("SHARE");
  command
      .add_option("--start-jitter", arguments.start_jitter,
                  "Each participant starts up to this much later")
      ->type_name("DURATION");
  command.add_option("--jobs", options.threads, "Runs at the same time (default: all cores)")
      ->check(CLI::Range(1, 4'096))
      ->type_name("N");
}

}  // namespace

void declare_tune(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<TuneArguments>();
  CLI::App* command = app.add_subcommand(
      "tune", "Search the settings that a user can change for the shortest discovery");
  add_scenario(*command, arguments->scenario, arguments->overrides);
  add_study_options(*command, *arguments);
  command
      ->add_option(
          "-o,--output", arguments->output,
          "Write the recommended setting and the front as vendor XML: a folder, or FILE.xml")
      ->type_name("DIR|FILE.xml");
  command->add_option("--svg", arguments->svg_file, "Plot completion against messages")
      ->type_name("FILE");
  command->add_flag("--check", arguments->check,
                    "Also ask every engine about the recommended setting");
  add_format(*command, arguments->json);
  add_progress(*command, arguments->progress);
  command->footer(
      "Exit code: 0 something better was found, or nothing better exists (the output says which),\n"
      "1 with --check a property is newly violated, 2 bad input, 3 interrupted.");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return tune_scenario(*arguments); }; });
}

}  // namespace stormproof::cli
