// What stands at the place where two runs part, read from logs of both runs around it. What one run
// does and the other does not do at that moment is looked for later in the other.
#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "checker/experiments/diff/first_difference.hpp"
#include "checker/experiments/diff/run_log.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/verification/counterexample/history.hpp"
#include "model/simulator.hpp"
#include "model/trace/event_subject.hpp"
#include "model/trace/perfetto_labels.hpp"
#include "props/monitors/describe.hpp"

namespace stormproof::diff {

namespace {

using model::Scenario;
using props::time_text;

// How far beyond the parting the other run is followed.
constexpr std::size_t packets_beyond = 2'000;
constexpr std::uint64_t events_beyond = 20'000;

/// A run around the parting, in full.
struct Logged {
  RunLog log;
  model::RunResult result;
};

Logged log_run(const Scenario& scenario, const Parting& parting) {
  const bool packets = parting.kind == Parting::Kind::packets;
  Logged run{RunLog{packets ? parting.position : UINT64_MAX,
                    packets ? UINT64_MAX : parting.position, packets ? packets_beyond : 1},
             {}};
  model::RunOptions options;
  options.probe = &run.log;
  std::uint64_t last = UINT64_MAX;
  if (!packets) options.max_events = parting.position + 1;
  // The place is reached in any case; from there on so many events.
  options.on_progress = [&](const model::Progress& progress) {
    if (packets && last == UINT64_MAX && !run.log.packets.empty()) {
      last = progress.events + events_beyond;
    }
    return progress.events < last;
  };
  run.result = model::simulate(scenario, options);
  return run;
}

std::string kind_text(const SentPacket& sent) {
  if (sent.label == "SPDP") return "an SPDP announcement";
  if (sent.label.find("DATA") != std::string::npos) return sent.label;
  const bool vowel = sent.label.starts_with('A') || sent.label.starts_with('i');
  return (vowel ? "an " : "a ") + sent.label;
}

std::string receivers_text(const SentPacket& sent) {
  if (sent.destinations.empty()) return "everybody";
  return fmt::format("participant{} {}", sent.destinations.size() == 1 ? "" : "s",
                     fmt::join(sent.destinations, ", "));
}

std::string content_text(const SentPacket& sent) {
  const std::string members = counterexample::members_text(sent.descriptors);
  std::string content = fmt::format("{} bytes", report::grouped(sent.bytes));
  if (sent.kind == model::PacketKind::data) content += ", descriptors " + members;
  if (sent.kind == model::PacketKind::acknack) {
    content += members.empty() ? ", lacks nothing" : ", lacks " + members;
    if (sent.detail > 0) content += fmt::format(", base {}", sent.detail);
  }
  if (sent.kind == model::PacketKind::heartbeat && sent.detail > 0) {
    content += fmt::format(", announces {}", sent.detail);
  }
  return content;
}

/// "an ACKNACK to participant 0 (pub)".
std::string object_text(const SentPacket& sent) {
  const bool has_stream = sent.kind == model::PacketKind::data ||
                          sent.kind == model::PacketKind::heartbeat ||
                          sent.kind == model::PacketKind::acknack;
  return fmt::format("{} to {}{}", kind_text(sent), receivers_text(sent),
                     has_stream ? fmt::format(" ({})", name_of(sent.stream)) : "");
}

std::string deed_text(const SentPacket& sent) {
  return fmt::format("participant {} sends {}: {}", sent.source, object_text(sent),
                     content_text(sent));
}

const SentPacket* find_like(const std::vector<SentPacket>& packets, const SentPacket& wanted) {
  const auto found =
      std::ranges::find_if(packets, [&](const SentPacket& sent) { return sent.is_like(wanted); });
  return found == packets.end() ? nullptr : &*found;
}

std::uint64_t last_event(const Logged& run) {
  return run.log.processed() == 0 ? 0 : run.log.processed() - 1;
}

/// What a run does that has nothing more to send.
Side silent_side(const Logged& run) {
  return {
      last_event(run),
      run.result.end_time,
      fmt::format("Nothing more is sent until the run ends at {}.", time_text(run.result.end_time)),
      {}};
}

Side side_of(const SentPacket& sent) {
  return {sent.event, sent.time, fmt::format("At {} {}.", time_text(sent.time), deed_text(sent)),
          sent.numbers};
}

/// One run sends `deed`; the other does so later or, as far as it was followed, not at all.
FirstDifference later_or_never(const SentPacket& deed, const Logged& other, const char* in_leader,
                               const char* in_other) {
  FirstDifference difference;
  difference.base = side_of(deed);  // the leader's; the caller turns the sides
  const SentPacket* const late = find_like(other.log.packets, deed);
  const std::string at =
      fmt::format("At {} participant {} sends {} in the {}", time_text(deed.time), deed.source,
                  object_text(deed), in_leader);
  if (late != nullptr) {
    difference.candidate = side_of(*late);
    difference.text =
        fmt::format("{}; in the {} the next such packet is sent {} later, at {}.", at, in_other,
                    time_text(late->time - deed.time), time_text(late->time));
  } else if (!other.log.packets.empty()) {
    const SentPacket& next = other.log.packets.front();
    difference.candidate = side_of(next);
    difference.text =
        fmt::format("{}; in the {} it does not, and next is {}, sent by participant {} at {}.", at,
                    in_other, object_text(next), next.source, time_text(next.time));
  } else {
    difference.candidate = silent_side(other);
    difference.is_silent = true;
    difference.text = fmt::format("{}; in the {} nothing more is sent until the run ends at {}.",
                                  at, in_other, time_text(other.result.end_time));
  }
  return difference;
}

/// Both send something at the same time that can be compared.
FirstDifference at_once(const SentPacket& one, const SentPacket& other) {
  FirstDifference difference{side_of(one), side_of(other), false, {}};
  if (one.is_like(other)) {
    const bool same_kind = one.label == other.label;
    difference.text =
        fmt::format("At {} participant {} sends {}: {} in the base, {}{} in the candidate.",
                    time_text(one.time), one.source, object_text(one), content_text(one),
                    same_kind ? "" : kind_text(other) + ", ", content_text(other));
    return difference;
  }
  const auto who = one.source == other.source ? std::string{}
                                              : fmt::format("participant {} sends ", other.source);
  difference.text =
      fmt::format("At {} participant {} sends {} in the base; in the candidate {}{}.",
                  time_text(one.time), one.source, object_text(one), who, object_text(other));
  return difference;
}

/// Whether the packets contain the like of `deed` at the same time.
bool happens_at_once(const std::vector<SentPacket>& packets, const SentPacket& deed) {
  return std::ranges::any_of(packets, [&](const SentPacket& sent) {
    return sent.time == deed.time && sent.is_like(deed);
  });
}

/// Whether they differ in their receivers or in their content alone.
bool are_comparable(const SentPacket& one, const SentPacket& other) {
  return one.time == other.time && one.source == other.source && one.stream == other.stream &&
         one.label == other.label;
}

FirstDifference of_packets(const Logged& base, const Logged& candidate) {
  const auto& ours = base.log.packets;
  const auto& theirs = candidate.log.packets;
  const auto base_leads = [&] {
    return later_or_never(ours.front(), candidate, "base", "candidate");
  };
  const auto candidate_leads = [&] {
    FirstDifference turned = later_or_never(theirs.front(), base, "candidate", "base");
    std::swap(turned.base, turned.candidate);
    return turned;
  };
  if (theirs.empty()) return base_leads();
  if (ours.empty()) return candidate_leads();
  const SentPacket& one = ours.front();
  const SentPacket& other = theirs.front();
  if (one.time != other.time) return one.time < other.time ? base_leads() : candidate_leads();
  if (one.is_like(other) || are_comparable(one, other)) return at_once(one, other);
  if (!happens_at_once(theirs, one)) return base_leads();
  if (!happens_at_once(ours, other)) return candidate_leads();
  return at_once(one, other);  // another order
}

/// "the HEARTBEAT expiry of participant 0's pub writer".
std::string event_text(const LoggedEvent& event, const model::Topology& topology) {
  using model::trace::Subject;
  const std::string name = class_of(event.kind) == model::EventClass::protocol
                               ? model::trace::timer_label(event.kind)
                               : name_of(event.kind);
  switch (model::trace::subject_of(event.kind)) {
    case Subject::relation:
      return fmt::format("{} for {}", name, props::relation_text(topology, event.subject));
    case Subject::writer:
      return fmt::format("{} of {}", name, props::writer_text(event.subject));
    case Subject::participant:
      return fmt::format("{} of participant {}", name, event.subject);
    default:
      return name;
  }
}

Side inner_side(const Logged& run, const Scenario& scenario) {
  if (run.log.events.empty()) {
    return {last_event(run),
            run.result.end_time,
            fmt::format("the run has ended at {}", time_text(run.result.end_time)),
            {}};
  }
  const model::Topology topology = model::topology_of(scenario);
  const LoggedEvent& event = run.log.events.front();
  std::string text =
      fmt::format("{} is processed at {}", event_text(event, topology), time_text(event.time));
  text += event.changes.empty() ? " and changes no state"
                                : fmt::format(" ({})", fmt::join(event.changes, ", "));
  return {last_event(run), event.time, std::move(text), {}};
}

FirstDifference of_inside(Side base, Side candidate) {
  FirstDifference difference{std::move(base), std::move(candidate), false, {}};
  difference.text = fmt::format("No packet differs; in the base {}, in the candidate {}.",
                                difference.base.text, difference.candidate.text);
  for (Side* const side : {&difference.base, &difference.candidate}) {
    side->text = fmt::format("No packet differs: {}.", side->text);
  }
  return difference;
}

}  // namespace

FirstDifference describe_parting(const Scenario& scenario, const model::DdsProfile& candidate,
                                 const Parting& parting) {
  Scenario changed = scenario;
  changed.dds = candidate;
  const Logged base = log_run(scenario, parting);
  const Logged other = log_run(changed, parting);
  if (parting.kind == Parting::Kind::packets) return of_packets(base, other);
  return of_inside(inner_side(base, scenario), inner_side(other, changed));
}

}  // namespace stormproof::diff
