// `stormproof fuzz SCENARIO`: runs many variants of a scenario, drawn within ranges, and looks for
// one that breaks a property or a limit. What breaks is shrunk and written.
#include <fmt/core.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/counterexample_files.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/fuzz_input.hpp"
#include "checker/cli/output_folder.hpp"
#include "checker/experiments/fuzz/fuzz_report.hpp"
#include "checker/presentation/text/command_line.hpp"
#include "checker/verification/check/next_steps.hpp"
#include "checker/verification/counterexample/story.hpp"
#include "model/config/knobs/effective.hpp"

namespace stormproof::cli {

namespace {

constexpr std::size_t usual_runs = 200;
constexpr std::size_t most_runs = 1'000'000;
/// Of `--time`: the rest is for those that run then, and for what breaks to be shrunk.
constexpr double for_variants = 0.8;

/// Writes ID.yaml, .txt, .mmd, .svg and .jsonl of every shrunk counterexample.
void write_shrunk(OutputFolder& folder, const fuzz::FuzzReport& report,
                  fuzz::FuzzContext& context) {
  for (const fuzz::Judgment& judgment : report.judgments) {
    if (!judgment.shrunk) continue;
    const props::Counterexample& found = judgment.shrunk->counterexample;
    const std::string id{judgment.id};
    const std::string description = fmt::format("# {}\n# found by: {}\n", found.reason,
                                                context.single(report, judgment.first_broken));
    const auto scenario =
        folder.write(id + ".yaml", description + model::config::effective_yaml(found.scenario));
    folder.write(id + ".txt", counterexample::story(found));
    const auto trace = write_counterexample(folder, found, id);
    if (trace) context.traces.emplace(judgment.id, *trace);
    if (!scenario) continue;
    const std::size_t ending = std::string_view{".yaml"}.size();
    context.stems.emplace(judgment.id, scenario->substr(0, scenario->size() - ending));
  }
}

fuzz::FuzzOptions options_of(const FuzzArguments& arguments, std::vector<std::string> ids,
                             Session& session) {
  fuzz::FuzzOptions options;
  options.seconds = arguments.seconds;
  if (const auto time = Session::time(); time.is_limited()) {
    options.seconds = time.part(for_variants).left();
  }
  options.runs = arguments.runs.value_or(options.seconds ? most_runs : usual_runs);
  options.seed = arguments.seed;
  options.first = arguments.first;
  options.jobs = arguments.jobs;
  options.only = std::move(ids);
  options.on_progress = [&session, timed = options.seconds.has_value(),
                         runs = options.runs](const fuzz::FuzzProgress& progress) {
    return session.proceed([&] {
      std::string text = timed ? fmt::format("{} runs", progress.finished)
                               : fmt::format("{} of {} runs", progress.finished, runs);
      text += progress.shrinking.empty() ? fmt::format(", {} violate something", progress.violating)
                                         : fmt::format("; shrinking {}", progress.shrinking);
      return text + fmt::format(", {:.0f} s", session.seconds());
    });
  };
  return options;
}

/// The first counterexample that was written, or what a sample cannot say.
report::NextStep next_of(const fuzz::FuzzReport& report, const fuzz::FuzzContext& context,
                         const FuzzArguments& arguments) {
  for (const fuzz::Judgment& judgment : report.judgments) {
    const auto trace = context.traces.find(judgment.id);
    if (trace == context.traces.end()) continue;
    return {report::command_line({"replay", trace->second}),
            "the shortest violation that was found, again, event by event"};
  }
  return {report::command_line({"check"}) + " " +
              checker::words_of(arguments.scenario, arguments.overrides),
          "what holds for all runs, not only for those that were drawn"};
}

Outcome run(FuzzArguments& arguments, Session& session) {
  const auto scenario = read_scenario(arguments);
  if (!scenario) return scenario.error();
  const auto ids = ids_to_judge(arguments, *scenario);
  if (!ids) return ids.error();
  std::vector<fuzz::KnobRange> knobs;
  for (const std::string& text : arguments.vary) {
    const auto range = fuzz::parse_knob_range(text, *scenario);
    if (!range) return range.error();
    knobs.push_back(*range);
  }
  OutputFolder folder{
      "--counterexamples", arguments.output_directory, "fuzz", {arguments.scenario}};
  if (const auto error = folder.prepare()) return Complaint{*error};
  const fuzz::Ranges ranges = fuzz::ranges_around(*scenario, std::move(knobs));
  const fuzz::FuzzReport report =
      fuzz::fuzz(*scenario, ranges, options_of(arguments, *ids, session));
  fuzz::FuzzContext context{arguments.scenario,
                            *scenario,
                            session.command({"--runs", "--seconds", "--time", "--seed", "--first"}),
                            {},
                            {}};
  Answer answer;
  if (arguments.seconds) {
    answer.notes.emplace_back("stormproof: --seconds is given up; --time 60s says it");
  }
  write_shrunk(folder, report, context);
  answer.complaint = folder.error().value_or("");
  answer.listing = folder.listing();
  // Its command says how many runs there was time for, which is never twice the same.
  answer.document = document_of(report, context);
  answer.json = to_json(report, context);
  answer.document.next = {next_of(report, context, arguments)};
  return answer;
}

void declare_ranges(Options& options, FuzzArguments& arguments) {
  options.text("--start-jitter", arguments.start_jitter,
               "Each participant starts up to this much later (as vary.start_jitter; 0: none)",
               "TIME");
  options.text("--loss", arguments.loss,
               "Each packet is lost with this probability, such as 2% or 0.02", "RATIO");
  options.text("--sizes", arguments.sizes, "Sizes of packets vary by so much, such as 10%",
               "RATIO");
  options.text("--delays", arguments.delays, "Airtime overheads, rates and delays vary by so much",
               "RATIO");
  options.text("--timers", arguments.timers,
               "Periods and delays of the DDS profile vary by so much", "RATIO");
  options.texts("--vary", arguments.vary,
                "Draw a numeric knob of a profile from a range, or how far apart processes start: "
                "deployment.launch (repeatable)",
                "KEY=LO..HI");
}

void declare(Options& options, FuzzArguments& arguments) {
  options.scenario(arguments.scenario, arguments.overrides);
  declare_ranges(options, arguments);
  options.texts("--limit", arguments.limits,
                "Set a limit: completion, messages, amplification or backlog (repeatable)",
                "NAME=VALUE");
  options.texts("--property", arguments.properties,
                "Judge only by this property or limit.NAME, and by --limit (repeatable)", "ID");
  options.number("--runs", arguments.runs, "Number of variants (default 200)", "N")
      .within(std::size_t{1}, most_runs);
  options
      .number("--seconds", arguments.seconds,
              "Given up, --time 60s says it: start no run after this time", "S")
      .within(0.001, 1e6);
  options.seed(arguments.seed, "Seed of the variants (default 0)");
  options.number("--first", arguments.first, "Number of the first variant (default 0)", "K")
      .within(std::int64_t{0}, std::int64_t{1'000'000'000'000});
  options.jobs(arguments.jobs);
  options.folder("--counterexamples", arguments.output_directory,
                 usual_folder_help("Where counterexamples are written", "fuzz-SCENARIO"));
}

}  // namespace

void declare_fuzz(Frame& frame) {
  frame.add<FuzzArguments>(
      {"fuzz",
       "Run variants of a scenario within ranges and look for one that breaks its limits",
       "Exit code: 0 no run of the sample breaks anything, 1 one does, 2 bad input,\n"
       "3 interrupted, or no run finished.",
       Formats::findings,
       {fuzz::json_schema}},
      declare, run);
}

}  // namespace stormproof::cli
