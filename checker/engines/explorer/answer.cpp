// Scopes and reasons in words.
#include "checker/engines/explorer/answer.hpp"

#include <fmt/core.h>

#include "model/implementations.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/monitors.hpp"

namespace stormproof::explorer {

namespace {

using props::Finding;
using props::VerdictKind;

const char* reason_of(CutShort cut_short) {
  switch (cut_short) {
    case CutShort::by_limit:
      return "the limit of states is reached";
    case CutShort::by_overflow:
      return "more events are pending, or more packets leave at once, than a state can hold";
    case CutShort::by_interruption:
      return "interrupted";
    case CutShort::no:
      break;
  }
  return "";
}

/// ", or 2 of one writer"; empty: one only.
std::string several_relations(const Surroundings& where) {
  std::string text;
  if (where.readers > 1) text += fmt::format(", or {} of one writer", where.readers);
  if (where.writers > 1) text += ", or one of each writer of a participant";
  return text;
}

void add(std::string& list, const std::string& what) { list += (list.empty() ? "" : "; ") + what; }

}  // namespace

std::vector<std::string> assumptions_of(const model::Scenario& running, const Surroundings& where) {
  std::vector<std::string> list;
  const std::string several = several_relations(where);
  list.push_back(
      several.empty()
          ? "One relation; every packet of it has a delay of its own. What it shares with other "
            "relations of its writer and participant is its own."
          : fmt::format("One relation{}; every packet of theirs has a delay of its own, or the "
                        "one that the scope names. What they share with other relations of the "
                        "participant is theirs alone.",
                        several));
  list.push_back(where.delay.origin);
  if (props::has_samples(running)) {
    list.emplace_back("Threads do at once what they are woken for; sending takes no time.");
    list.emplace_back("A repair of all samples that are explored fits into one packet.");
    return list;
  }
  const bool created = creates_over_time(running);
  if (created) list.emplace_back("No HEARTBEATs ride in DATA packets.");
  const model::SedpProfile& sedp = running.dds.sedp;
  if (sedp.initial_acknack_delay.count() > 0 &&
      sedp.initial_acknack_interval == model::InitialAckNackInterval::doubling) {
    list.emplace_back("The delay between initial ACKNACKs doubles six times.");
  }
  const Splitting split = splitting(running);
  if (split.cannot_follow()) {
    list.push_back(
        fmt::format("All descriptors of the relation share a packet; the scenario's "
                    "largest relation takes {}.",
                    split.in_scenario));
  }
  if (running.wireless.kind == model::ServiceKind::shared_channel &&
      model::traits_of(running.dds).waits_for_source) {
    list.emplace_back(
        "A repair leaves its source after what is received at the same instant, as with a constant "
        "delay; on a shared channel it can be before.");
  }
  return list;
}

void Answer::note_scope(const Scope& scope, Claim claim, const SearchResult& result,
                        const Bounds& bounds) {
  std::string line = fmt::format("{}: {} zone states", to_text(scope), result.states);
  if (!result.exhausted()) {
    const std::string depth = fmt::format("all paths of up to {} events", result.depth);
    line += fmt::format(", {}; {}", depth, reason_of(result.cut_short));
    add(cut_short_, fmt::format("{} ({})", short_text(scope), depth));
  } else if (claim == Claim::no_stall && result.undecided > 0) {
    line += fmt::format(", {} of which are undecided: not all of their paths lead to reception",
                        result.undecided);
    add(cut_short_, short_text(scope) + " (explored, but undecided)");
  } else {
    add(exhausted_, short_text(scope));
  }
  details_.push_back(std::move(line));
  if (bounds.completion) {
    details_.push_back(fmt::format("{}: the latest completion is at {}, B = {}.", to_text(scope),
                                   props::time_text(result.latest_completion),
                                   props::time_text(*bounds.completion)));
  }
}

void Answer::note_counterexample(const Scope& scope, std::size_t events,
                                 props::Counterexample counterexample) {
  counterexample_ = std::move(counterexample);
  found_in_ = fmt::format("{} events; {}", events, to_text(scope));
}

void Answer::note_dispute(const Scope& scope, std::size_t events, const std::string& why_not) {
  disputed_ =
      fmt::format("A path of {} events ({}) was found, but: {}", events, to_text(scope), why_not);
}

void Answer::note_effort(std::uint64_t states, double seconds) {
  states_ += states;
  seconds_ += seconds;
}

std::string Answer::what_was_explored(const Surroundings& surroundings) const {
  std::string several;
  if (surroundings.readers > 1) {
    several += fmt::format(", and of {} of one writer", surroundings.readers);
  }
  if (surroundings.writers > 1) several += ", and of one of each writer of a participant";
  if (!several.empty()) several += ',';
  return fmt::format("one relation{} with packet delays up to {}, {} zone states", several,
                     props::time_text(surroundings.delay.delay), states_);
}

Finding Answer::finding(Claim claim, const Surroundings& surroundings) const {
  Finding finding;
  finding.engine = "explorer";
  finding.seconds = seconds_;
  finding.assumptions = surroundings.assumptions;
  finding.details = details_;
  if (counterexample_) {
    finding.kind = VerdictKind::violated;
    finding.counterexample = counterexample_;
    finding.how = "the first path that breaks it, " + found_in_ + "; replayed";
  } else if (!disputed_.empty()) {
    dispute(finding, disputed_);
  } else if (surroundings.interrupted) {
    finding.how = "interrupted";
  } else if (exhausted_.empty() && cut_short_.empty()) {
    finding.how = claim == Claim::completion
                      ? "no scope in which the bound counts from the start of the explored world"
                      : "no scope";
  } else if (exhausted_.empty()) {
    finding.how = fmt::format("no objection, but no scope was exhausted: {}: {}",
                              what_was_explored(surroundings), cut_short_);
  } else {
    finding.kind = VerdictKind::bounded;
    finding.longest_delay = surroundings.delay.delay;
    finding.how =
        fmt::format("all interleavings of {}: {}", what_was_explored(surroundings), exhausted_);
    if (!cut_short_.empty()) finding.how += "; not decided: " + cut_short_;
  }
  return finding;
}

}  // namespace stormproof::explorer
