// `stormproof replay TRACE`: runs the scenario of a trace again and compares every event. Of a
// counterexample it also says whether the violation occurs.
#include <fmt/core.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/rendered.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/paragraph.hpp"
#include "checker/verification/counterexample/observe.hpp"
#include "model/trace/replay.hpp"
#include "props/monitors/describe.hpp"
#include "props/property.hpp"

namespace stormproof::cli {

namespace {

struct ReplayArguments {
  std::string file;  ///< written by `stormproof simulate --trace` or `stormproof check`
};

using model::trace::Difference;
using model::trace::Replay;
using model::trace::TraceViolation;
using model::trace::Verdict;

ExitCode exit_code(const Replay& replay) {
  switch (replay.verdict) {
    case Verdict::identical:
      return established;
    case Verdict::different:
      // A counterexample that does not happen again says nothing about its property.
      return replay.expected ? inconclusive : violated;
    case Verdict::violated:
      return violated;
    case Verdict::not_violated:
    case Verdict::ends_early:
    case Verdict::stopped:
      return inconclusive;
  }
  return internal_error;
}

nlohmann::ordered_json to_json(const std::optional<TraceViolation>& violation) {
  if (!violation) return nullptr;
  return to_json(*violation);
}

nlohmann::ordered_json to_json(const std::string& file, const Replay& replay) {
  nlohmann::ordered_json json;
  json["verdict"] = name_of(replay.verdict);
  json["trace"] = file;
  json["recorded_by"] = replay.recorded_by;
  json["lines_that_agree"] = replay.lines;
  json["events_that_agree"] = replay.events;
  json["last_event_ns"] = replay.last_time.count();
  json["t_disc_ns"] = nullptr;
  if (replay.discovery_time) json["t_disc_ns"] = replay.discovery_time->count();
  json["expected"] = to_json(replay.expected);
  json["violation"] = to_json(replay.violation);
  json["difference"] = nullptr;
  if (!replay.difference) return json;
  const Difference& difference = *replay.difference;
  json["difference"] = {{"line", difference.line},
                        {"key", difference.mismatch.key},
                        {"recorded", difference.mismatch.recorded},
                        {"replayed", difference.mismatch.replayed},
                        {"recorded_line", difference.recorded_line},
                        {"replayed_line", difference.replayed_line}};
  return json;
}

std::string agreement(const Replay& replay) {
  if (replay.events == 0) return "no event was compared";
  return fmt::format("the first {} event{} happen{} again, up to {}",
                     report::grouped(replay.events), replay.events == 1 ? "" : "s",
                     replay.events == 1 ? "s" : "", report::duration(replay.last_time));
}

std::string text_of(const std::string& file, const Replay& replay) {
  const Difference& difference = *replay.difference;
  std::string text =
      fmt::format("{}: {}:{} is not what happens in the replay\n\n",
                  replay.expected ? "INCONCLUSIVE" : "DIFFERENT", file, difference.line);
  const std::string& key = difference.mismatch.key;
  text += fmt::format("  key       {}\n", key.empty() ? "(the whole line)" : key);
  text += fmt::format("  recorded  {}\n", difference.mismatch.recorded);
  text += fmt::format("  replayed  {}\n\n", difference.mismatch.replayed);
  return text;
}

std::string text_of(const TraceViolation& violation) {
  const props::Property* property = props::find_property(violation.property);
  std::string text =
      fmt::format("VIOLATED: {} at event {}, {}\n\n", violation.property,
                  report::grouped(violation.event), props::time_text(violation.time));
  if (property != nullptr) text += report::paragraph("  statement  ", property->statement);
  return text + report::paragraph("  reason     ", violation.reason) + "\n";
}

/// Why a counterexample whose events all happen again is none.
std::string text_of_absence(const std::string& file, const Replay& replay) {
  std::string text =
      fmt::format("INCONCLUSIVE: {} expects a violation of {} at event {}, {}.\n", file,
                  replay.expected->property, report::grouped(replay.expected->event),
                  props::time_text(replay.expected->time));
  if (!replay.violation) return text + "Its events happen again, but nothing violates it.\n";
  return text +
         fmt::format("Its events happen again, but the violation occurs at event {}, {}:\n{}\n",
                     report::grouped(replay.violation->event),
                     props::time_text(replay.violation->time), replay.violation->reason);
}

std::string to_text(const std::string& file, const Replay& replay) {
  switch (replay.verdict) {
    case Verdict::identical: {
      const std::string end = replay.discovery_time ? "discovery completes after " +
                                                          report::duration(*replay.discovery_time)
                                                    : "discovery does not complete";
      return fmt::format("IDENTICAL: all {} events of {} happen again, to the nanosecond; {}\n",
                         report::grouped(replay.events), file, end);
    }
    case Verdict::different:
      return text_of(file, replay) + "Before that, " + agreement(replay) + ".\n";
    case Verdict::violated:
      return text_of(*replay.violation) +
             fmt::format("All {} events of {} happen again, to the nanosecond.\n",
                         report::grouped(replay.events), file);
    case Verdict::not_violated:
      return text_of_absence(file, replay);
    case Verdict::ends_early:
      return fmt::format(
          "INCONCLUSIVE: {} ends before the run does; it was interrupted.\nAll that it has "
          "agrees: {}.\n",
          file, agreement(replay));
    case Verdict::stopped:
      return fmt::format("INCONCLUSIVE: the replay was interrupted. So far, {}.\n",
                         agreement(replay));
  }
  return "";
}

Outcome run(ReplayArguments& arguments, Session& session) {
  const auto result =
      model::trace::replay(arguments.file, model::config::SpecPath::standard(),
                           session.on_simulation(), counterexample::catalogue_watches());
  if (!result) return result.error();
  Answer answer;
  answer.exit_code = exit_code(*result);
  answer.json = to_json(arguments.file, *result);
  answer.rendered =
      rendered(session, [&](report::Format) { return to_text(arguments.file, *result); });
  return answer;
}

void declare(Options& options, ReplayArguments& arguments) {
  options.text("trace", arguments.file, "File written by simulate --trace or by check", "FILE")
      .required();
}

}  // namespace

void declare_replay(Frame& frame) {
  frame.add<ReplayArguments>(
      {"replay", "Run the scenario of a trace or counterexample again and compare every event",
       "Exit code of a trace: 0 identical, 1 different, 3 the trace ends early.\n"
       "Of a counterexample: 1 the violation occurs, 3 it does not. 2 bad input.",
       Formats::plain},
      declare, run);
}

}  // namespace stormproof::cli
