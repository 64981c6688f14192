// Laws of repetition: a scenario has one run, and what is no part of the rules does not touch it.
#include "props/laws/families.hpp"
#include "props/laws/run_log.hpp"

namespace stormproof::props {

namespace {

using model::Scenario;
using Broken = std::optional<std::string>;

Broken determinism(const Scenario& scenario, const Simulate& simulate) {
  return run_difference(scenario, scenario, simulate);
}

/// An observer sees a run, and does not change it.
Broken observation(const Scenario& scenario, const Simulate& simulate) {
  RunLog log;
  return result_difference(simulate(scenario, nullptr), simulate(scenario, &log));
}

/// A completed run ends before the limit.
Broken later_limit(const Scenario& scenario, const Simulate& simulate) {
  Scenario later = scenario;
  later.run_until = model::RunUntil::completion;
  RunLog first;
  const model::RunResult a = simulate(later, &first);
  if (!a.completed()) return std::nullopt;
  later.time_limit = later.time_limit * 2 + model::Nanoseconds{1};
  RunLog second;
  const model::RunResult b = simulate(later, &second);
  if (Broken difference = first_difference(first, second)) return difference;
  return result_difference(a, b);
}

Broken earlier_limit(const Scenario& scenario, const Simulate& simulate) {
  Scenario shorter = scenario;
  shorter.time_limit = model::Nanoseconds{scenario.time_limit.count() / 3};
  RunLog part;
  const model::RunResult cut = simulate(shorter, &part);
  RunLog whole;
  static_cast<void>(simulate(scenario, &whole));
  if (Broken difference = first_difference(part, whole, part.entries().size())) return difference;
  if (cut.end != model::RunEnd::time_limit || whole.entries().size() == part.entries().size()) {
    return std::nullopt;
  }
  const RunLog::Entry& next = whole.entries()[part.entries().size()];
  if (next.time > shorter.time_limit) return std::nullopt;
  return "The shorter run leaves out an event that is not after its limit.";
}

/// Completion ends nothing but the run: up to it both kinds of run are the same.
Broken run_until(const Scenario& scenario, const Simulate& simulate) {
  Scenario until_completion = scenario;
  until_completion.run_until = model::RunUntil::completion;
  Scenario until_limit = scenario;
  until_limit.run_until = model::RunUntil::time_limit;
  RunLog first;
  RunLog second;
  const model::RunResult a = simulate(until_completion, &first);
  const model::RunResult b = simulate(until_limit, &second);
  if (was_cut_off(a) || was_cut_off(b)) return std::nullopt;
  // The event that completes discovery is left in the middle by one run.
  const std::size_t same = a.completed() ? first.entries().size() - 1 : SIZE_MAX;
  if (Broken difference = first_difference(first, second, same)) return difference;
  if (a.discovery_time == b.discovery_time) return std::nullopt;
  return "The completion time depends on what ends the run.";
}

Broken unused_values(const Scenario& scenario, const Simulate& simulate) {
  Scenario other = scenario;
  other.limits = model::Limits{};
  other.limits->messages = 1;
  other.vary = model::Variation{};
  other.vary->loss = model::Ratio{1, 2};
  other.deployment.schedule = model::Schedule{};
  model::WirelessProfile& wireless = other.wireless;
  if (wireless.kind == model::ServiceKind::constant_delay) {
    wireless.overhead_unicast = model::Nanoseconds{1};
    wireless.rate_multicast = model::BitsPerSecond{1};
    wireless.source_queue_bytes = model::Bytes{1};
    wireless.order = model::ServiceOrder::datagram_uplink;
  } else {
    wireless.one_way = wireless.one_way + model::Nanoseconds{1};
  }
  model::SedpProfile& sedp = other.dds.sedp;
  if (sedp.heartbeat_policy == model::HeartbeatPolicy::periodic) {
    sedp.adaptive = {model::Nanoseconds{1}, model::Nanoseconds{2}, 1, 2};
  }
  if (sedp.piggyback == model::Piggyback::off) sedp.piggyback_threshold_bytes = model::Bytes{0};
  if (sedp.relation_opening == model::RelationOpening::receiver) {
    sedp.unmatched = model::Unmatched::accept;
  }
  if (!traits_of(other).discovers_same_host) {
    other.deployment.loopback_delay = model::Nanoseconds{1};
  }
  return run_difference(scenario, other, simulate);
}

constexpr Law repetition_list[] = {
    {"law.determinism", "Two runs of a scenario are the same, event by event.", always,
     determinism},
    {"law.observation", "A run that is observed has the result of one that is not.", always,
     observation},
    {"law.later-limit", "A later time limit changes nothing in a run that completes discovery.",
     always, later_limit},
    {"law.earlier-limit", "A run with an earlier time limit is the beginning of the longer one.",
     always, earlier_limit},
    {"law.run-until",
     "What happens before discovery is complete, and when that is, does not depend on run_until.",
     always, run_until},
    {"law.unused-values",
     "Limits, ranges to vary, and knobs that other knobs switch off change nothing.", always,
     unused_values},
};

}  // namespace

std::span<const Law> repetition_laws() { return repetition_list; }

}  // namespace stormproof::props
