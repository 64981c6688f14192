// `stormproof sensitivity SCENARIO`: which number of a scenario matters.
#include <fmt/core.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/durations.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/experiments/sensitivity/sensitivity_report.hpp"
#include "checker/presentation/text/command_line.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "checker/verification/check/next_steps.hpp"
#include "model/config/scenario_file.hpp"
#include "model/config/tree/quantities.hpp"
#include "props/applicability.hpp"

namespace stormproof::cli {

namespace {

using sensitivity::Description;
using sensitivity::Measure;

/// Runs of each change if nothing else is said and they differ.
constexpr std::size_t usual_samples = 20;
constexpr std::size_t usual_pairs = 5;

struct SensitivityArguments {
  std::string scenario;
  std::vector<std::string> overrides;
  std::string range = "20%";
  Measure by = Measure::completion;
  std::optional<std::size_t> samples;
  std::uint64_t seed = 0;
  std::string start_jitter;  ///< empty: that of the scenario's `vary`
  std::size_t pairs_of = 0;
  std::size_t shown = 15;
  std::size_t jobs = 0;
  OutputFile svg;
};

/// The options of the study; an error message if one is wrong.
model::config::Result<Description, std::string> describe(const SensitivityArguments& arguments,
                                                         const model::Scenario& scenario) {
  Description description;
  sensitivity::Options& options = description.options;
  const auto range = model::config::parse_share(arguments.range);
  if (!range || range->numerator == 0 || range->value() >= 1) {
    return fmt::format(
        "--range {}: expected a percentage, decimal or fraction between 0 and 1, "
        "such as 20%, 0.2 or 1/5",
        arguments.range);
  }
  options.range = range->value();
  const auto jitter = parse_start_jitter(arguments.start_jitter, scenario);
  if (!jitter) return jitter.error();
  options.start_jitter = *jitter;
  description.scenario = arguments.scenario;
  description.dds = scenario.dds;
  description.has_schedule = scenario.deployment.schedule.has_value();
  description.shown = arguments.shown;
  options.samples = arguments.samples.value_or(description.is_sampled() ? usual_samples : 1);
  if (options.samples > 1 && !description.is_sampled()) {
    return fmt::format(
        "{}: all {} samples would be the same run; give --start-jitter 10ms, or the deployment a "
        "schedule to draw from",
        arguments.scenario, options.samples);
  }
  options.first_seed = arguments.seed;
  options.by = arguments.by;
  options.pairs_of = arguments.pairs_of;
  options.threads = arguments.jobs;
  return description;
}

Outcome run(SensitivityArguments& arguments, Session& session) {
  const auto scenario = model::config::read_scenario(arguments.scenario, arguments.overrides,
                                                     model::config::SpecPath::standard());
  if (!scenario) return scenario.error();
  if (const auto why = props::why_profile_is_not_changed(*scenario); !why.empty()) {
    return model::config::InputError{arguments.scenario, std::string{why}};
  }
  auto described = describe(arguments, *scenario);
  if (!described) return Complaint{described.error()};
  Description& description = *described;
  description.options.on_progress = session.on_runs();
  description.options.time = Session::time();
  const sensitivity::Report report = sensitivity::analyse(*scenario, description.options);
  Answer answer;
  answer.document = document_of(report, description);
  Session::note_interruption(answer.document);
  answer.json = to_json(report, description);
  if (const auto change =
          sensitivity::best_change(report, description.options.by, description.dds)) {
    answer.document.next = {{report::command_line({"simulate"}) + " " +
                                 checker::words_of(arguments.scenario, arguments.overrides) +
                                 " --set " + report::shell_word(*change),
                             "of what a user can set the change that helps most, alone"}};
  }
  if (!report.finished) arguments.svg.discard();
  if (report.finished && arguments.svg.wanted()) {
    arguments.svg.stream() << to_svg(report, description);
  }
  return answer;
}

void declare(Options& options, SensitivityArguments& arguments) {
  options.scenario(arguments.scenario, arguments.overrides);
  options.text("--range", arguments.range, "How far each value goes down and up (default 20%)",
               "RANGE");
  options.choice("--by", arguments.by,
                 {{"completion", Measure::completion}, {"messages", Measure::messages}},
                 "Rank by completion (default) or messages", "MEASURE");
  options
      .number("--samples", arguments.samples,
              "Runs of each change with different start times (default 20 if they can differ)", "N")
      .within(1, 100'000);
  options.seed(arguments.seed, "Seed of the first start times (default 0)");
  options.start_jitter(arguments.start_jitter);
  options
      .number("--pairs", arguments.pairs_of,
              fmt::format("Interactions of the first N knobs (default {})", usual_pairs), "N")
      .or_alone(fmt::format("{}", usual_pairs))
      .within(2, 50);
  options.number("--top", arguments.shown, "Knobs in the text and the plot (default 15)", "N")
      .within(1, 10'000);
  options.jobs(arguments.jobs);
  options.svg(arguments.svg, "Write a tornado plot");
}

}  // namespace

void declare_sensitivity(Frame& frame) {
  frame.add<SensitivityArguments>(
      {"sensitivity",
       "Which knob matters: change every number a little and rank the effects",
       "Exit code: 0 all changes were run, 3 interrupted, 2 bad input.",
       Formats::pages,
       {sensitivity::json_schema}},
      declare, run);
}

}  // namespace stormproof::cli
