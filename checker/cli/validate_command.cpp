// `stormproof validate CAPTURE…`: predicts what a capture shows, and puts both side by side.
#include <fmt/core.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/durations.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/on_captures.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/cli/streams.hpp"
#include "checker/evidence/capture/events.hpp"
#include "checker/evidence/conform/conform.hpp"
#include "checker/evidence/validate/validate.hpp"
#include "model/config/knobs/effective.hpp"
#include "model/config/tree/quantities.hpp"

namespace stormproof::cli {

namespace {

struct ValidateArguments {
  std::vector<std::string> files;
  validate::Request request;
  std::string until, endpoints_done, loss, record;  ///< as written; empty: not given
  OutputFile svg;
  OutputFile scenario;
};

/// Options that are texts, as values of the request; what is wrong with one, or nothing.
std::optional<std::string> complete(validate::Request& request, const ValidateArguments& arguments,
                                    std::int64_t first_ns) {
  constexpr model::Nanoseconds longest{1'000'000'000'000'000};
  const auto until = parse_until(arguments.until, first_ns);
  if (!until) return until.error();
  if (!arguments.until.empty()) request.until_ns = *until;
  if (!arguments.endpoints_done.empty()) {
    const auto range = parse_duration_range("--endpoints-done", arguments.endpoints_done, longest);
    if (!range) return range.error();
    request.endpoints_done = *range;
  }
  if (!arguments.loss.empty()) {
    const auto loss = model::config::parse_share(arguments.loss);
    if (!loss || loss->value() >= 1) {
      return fmt::format("--loss '{}': expected a probability below 1, such as 5% or 0.05",
                         arguments.loss);
    }
    request.sampling.loss = loss->value();
  }
  return std::nullopt;
}

ExitCode exit_code(const validate::Report& report) {
  if (report.interrupted()) return inconclusive;
  if (report.agreement == validate::Agreement::beyond) return violated;
  const bool decided = report.agreement != validate::Agreement::undecided;
  return report.observation.complete && decided ? established : inconclusive;
}

Outcome run(ValidateArguments& arguments, Session& session) {
  validate::Request& request = arguments.request;
  // What needs no capture is refused before one is read.
  constexpr std::int64_t any_first = 0;
  if (const auto error = complete(request, arguments, any_first)) return Complaint{*error};
  if (!arguments.record.empty()) {
    auto record = validate::read_run_record(arguments.record);
    if (!record) return record.error();
    request.record = std::move(*record);
  }
  const auto conversation = capture::read_conversation(arguments.files, session.on_packets());
  if (!conversation) return conversation.error();
  if (Session::interrupted()) {
    say("stormproof: the captures were not read to the end; nothing was compared");
    return inconclusive;
  }
  if (const auto error = complete(request, arguments, conversation->first_ns)) {
    return Complaint{*error};
  }
  request.sampling.on_progress = session.on_runs();
  const auto report = validate::validate(*conversation, request);
  if (!report) return report.error();
  const validate::Heading heading{arguments.files};
  Answer answer{document_of(*report, heading), to_json(*report, heading)};
  answer.document.exit_code = exit_code(*report);
  if (!conform::refuse_profile(report->scenario.dds)) {
    answer.document.next = {{on_captures({"conform"}, arguments.files, {"--dds", request.dds}),
                             "whether the rules of this profile explain every message"}};
  }
  if (arguments.svg.wanted()) arguments.svg.stream() << to_svg(*report);
  if (arguments.scenario.wanted()) {
    arguments.scenario.stream() << model::config::effective_yaml(report->scenario);
  }
  if (report->interrupted()) {
    answer.notes.push_back(fmt::format("{} of {} runs finished", report->runs, report->wanted));
  }
  return answer;
}

void declare(Options& options, ValidateArguments& arguments) {
  validate::Request& request = arguments.request;
  options.captures(arguments.files);
  options.text("--dds", request.dds, "DDS profile to predict with", "PROFILE").required();
  options.text("--wireless", request.wireless, "Wireless profile", "PROFILE").required();
  options.overrides(request.overrides, "the scenario");
  options.text("--endpoints-done", arguments.endpoints_done,
               "When participants have all endpoints, instead of what the capture proves: "
               "durations after the first announcement",
               "LO..HI");
  options.text("--record", arguments.record,
               "When participants on the host of a Discovery Server started, which no capture "
               "shows: a JSON file, or a folder of them, as the live bed writes",
               "PATH");
  options.text("--loss", arguments.loss,
               "Each packet is lost with this probability, such as 5% or 0.05 (default 0)",
               "RATIO");
  options.number("--samples", request.sampling.samples, "Runs of the model (default 24)", "N")
      .within(1, 100'000);
  options.seed(request.sampling.first_seed, "Seed of the first run (default 0)");
  options.jobs(request.sampling.threads);
  options.until(arguments.until,
                "When discovery was complete, instead of at the last initial DATA");
  options
      .number("--within", request.within,
              "Exit code 1 if completion or messages are off by more than this factor", "RATIO")
      .within(1.0, 1e6);
  options.svg(arguments.svg, "Write a plot of the counts over time");
  options.output("--scenario", arguments.scenario,
                 "Write the scenario of the first run, as simulate reads it");
}

}  // namespace

void declare_validate(Frame& frame) {
  frame.add<ValidateArguments>(
      {"validate",
       "Predict the discovery in a capture: model beside observation",
       "Exit code: 0 the comparison was made, 1 it is beyond --within, 3 the capture is "
       "incomplete,\n"
       "or interrupted; 2 bad input.",
       Formats::pages,
       {validate::json_schema}},
      declare, run);
}

}  // namespace stormproof::cli
