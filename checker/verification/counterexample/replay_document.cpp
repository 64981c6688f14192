// What a replay says: the verdict, and where trace and replay part.
#include <fmt/core.h>

#include "checker/presentation/text/numbers.hpp"
#include "checker/verification/counterexample/replay_report.hpp"
#include "props/monitors/describe.hpp"
#include "props/property.hpp"

namespace stormproof::counterexample {

namespace {

using model::trace::Replay;
using model::trace::Verdict;
using report::duration;
using report::Facts;
using report::grouped;
using report::Tone;

std::string agreement(const Replay& replay) {
  if (replay.events == 0) return "no event was compared";
  return fmt::format("the first {} event{} happen{} again, up to {}", grouped(replay.events),
                     replay.events == 1 ? "" : "s", replay.events == 1 ? "s" : "",
                     duration(replay.last_time));
}

void add_difference(report::Document& document, const std::string& file, const Replay& replay) {
  const model::trace::Difference& difference = *replay.difference;
  document.tone = replay.expected ? Tone::warn : Tone::bad;
  document.answer =
      fmt::format("{}: {}:{} is not what happens in the replay",
                  replay.expected ? "INCONCLUSIVE" : "DIFFERENT", file, difference.line);
  const std::string& key = difference.mismatch.key;
  document.blocks.emplace_back(Facts{{{"key", key.empty() ? "(the whole line)" : key},
                                      {"recorded", report::code(difference.mismatch.recorded)},
                                      {"replayed", report::code(difference.mismatch.replayed)}}});
  document.blocks.emplace_back(report::Paragraph{"Before that, " + agreement(replay) + "."});
}

void add_violation(report::Document& document, const std::string& file, const Replay& replay) {
  const model::trace::TraceViolation& violation = *replay.violation;
  document.tone = Tone::bad;
  document.answer = fmt::format("VIOLATED: {} at event {}, {}", violation.property,
                                grouped(violation.event), props::time_text(violation.time));
  Facts facts;
  const props::Property* property = props::find_property(violation.property);
  if (property != nullptr) facts.rows.emplace_back("statement", property->statement);
  facts.rows.emplace_back("reason", violation.reason);
  document.blocks.emplace_back(std::move(facts));
  document.blocks.emplace_back(report::Paragraph{fmt::format(
      "All {} events of {} happen again, to the nanosecond.", grouped(replay.events), file)});
}

/// Why a counterexample whose events all happen again is none.
void add_absence(report::Document& document, const std::string& file, const Replay& replay) {
  document.tone = Tone::warn;
  document.answer = fmt::format("INCONCLUSIVE: {} expects a violation of {} at event {}, {}", file,
                                replay.expected->property, grouped(replay.expected->event),
                                props::time_text(replay.expected->time));
  if (!replay.violation) {
    document.elaboration = "Its events happen again, but nothing violates it.";
    return;
  }
  document.elaboration =
      fmt::format("Its events happen again, but the violation occurs at event {}, {}:",
                  grouped(replay.violation->event), props::time_text(replay.violation->time));
  document.blocks.emplace_back(report::Paragraph{replay.violation->reason});
}

}  // namespace

report::Document document_of(const std::string& file, const Replay& replay) {
  report::Document document;
  document.title = "stormproof replay " + file;
  switch (replay.verdict) {
    case Verdict::identical:
      document.tone = Tone::good;
      document.answer = fmt::format(
          "IDENTICAL: all {} events of {} happen again, to the nanosecond; {}",
          grouped(replay.events), file,
          replay.discovery_time ? "discovery completes after " + duration(*replay.discovery_time)
                                : "discovery does not complete");
      break;
    case Verdict::different:
      add_difference(document, file, replay);
      break;
    case Verdict::violated:
      add_violation(document, file, replay);
      break;
    case Verdict::not_violated:
      add_absence(document, file, replay);
      break;
    case Verdict::ends_early:
      document.tone = Tone::warn;
      document.answer =
          fmt::format("INCONCLUSIVE: {} ends before the run does; it was interrupted", file);
      document.elaboration = "All that it has agrees: " + agreement(replay) + ".";
      break;
    case Verdict::stopped:
      document.tone = Tone::warn;
      document.answer = "INCONCLUSIVE: the replay was interrupted";
      document.elaboration = "So far, " + agreement(replay) + ".";
      document.complete = false;
      break;
  }
  return document;
}

}  // namespace stormproof::counterexample
