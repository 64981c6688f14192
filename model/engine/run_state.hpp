// What all parts of one run share: the scenario, its numbering, the event queue and the clock, the
// counts, and the observer. One run owns one of these; nothing in it outlives the run and nothing
// is global.
#pragma once

#include "model/counts.hpp"
#include "model/engine/event_queue.hpp"
#include "model/engine/profiles.hpp"
#include "model/engine/topology.hpp"
#include "model/life.hpp"
#include "model/mutation.hpp"
#include "model/probe.hpp"
#include "model/run_result.hpp"
#include "model/scenario.hpp"

namespace stormproof::model {

struct RunState {
  /// `same_host`: which pairs of participants the implementation has.
  RunState(const Scenario& scenario_, Probe* probe_, const Mutation* mutation_ = nullptr,
           SameHostPairs same_host = SameHostPairs::left_out)
      : scenario{scenario_},
        profiles{scenario_},
        topology{scenario_.deployment, scenario_.dds.descriptors, same_host},
        probe{probe_},
        reports{probe_ == nullptr ? Reports{} : probe_->reports()},
        hears_single_packets{probe_ != nullptr && reports.tell_packets_apart() &&
                             probe_->wants_single_packets()},
        mutation{mutation_},
        ends_when_complete{scenario_.run_until == RunUntil::completion},
        settled_at{model::settled_at(scenario_.deployment)},
        missing{topology.required_deliveries()} {}

  /// Schedules an event. Returns how many were scheduled: one, unless the run has a mistake in it.
  [[gnu::always_inline]] std::uint32_t schedule(Nanoseconds time, EventKind kind,
                                                std::uint32_t subject, std::uint32_t detail = 0) {
    if (mutation != nullptr) [[unlikely]]
      return schedule_mutated(time, kind, subject, detail);
    const std::uint64_t insertion = queue.schedule(time, kind, subject, detail);
    if (who_hears(Report::scheduled) != nullptr) probe->scheduled(insertion, time, kind, subject);
    return 1;
  }

  /// Schedules an event that was due and was held back, now. Returns its new insertion number.
  std::uint64_t schedule_again(const Event& event) {
    const std::uint64_t insertion =
        queue.schedule_as(event.event_class(), now, event.kind, event.subject, event.detail);
    if (who_hears(Report::rescheduled) != nullptr) probe->rescheduled(event, insertion);
    return insertion;
  }
  /// An event that is due now, but is not in the queue: somebody holds it.
  [[nodiscard]] Event scheduled_aside(EventKind kind, std::uint32_t subject) {
    const Event event = queue.make(now, kind, subject);
    if (who_hears(Report::scheduled) != nullptr) {
      probe->scheduled(event.insertion(), now, kind, subject);
    }
    return event;
  }

  /// The probe if it wants to hear of this, or null.
  [[nodiscard]] Probe* who_hears(Report report) const {
    return reports.has(report) ? probe : nullptr;
  }

  [[nodiscard]] bool complete() const { return missing == 0; }
  /// Whether the run ends at once, in the middle of a packet.
  [[nodiscard]] bool ends_now() const {
    return complete() && ends_when_complete && now >= settled_at;
  }

  const Scenario& scenario;
  const Profiles profiles;  ///< of its participants
  const Topology topology;
  Probe* const probe;
  const Reports reports;  ///< that the probe wants
  const bool hears_single_packets;
  const Mutation* const mutation;  ///< a deliberate mistake, or none
  const bool ends_when_complete;
  const Nanoseconds settled_at;  ///< what is complete from then on stays so
  EventQueue queue;
  Nanoseconds now;
  Counts counts;
  std::uint64_t user_control = 0;  ///< messages of control-only relations
  std::uint64_t forgotten = 0;     ///< how often a lease ended
  std::uint64_t missing;           ///< required deliveries that have not happened
  std::uint64_t useful_deliveries = 0;
  std::uint64_t duplicate_deliveries = 0;
  MissingDescriptor
      last_delivered{};  ///< of a complete run: a descriptor of the packet that completed it

 private:
  std::uint32_t schedule_mutated(Nanoseconds time, EventKind kind, std::uint32_t subject,
                                 std::uint32_t detail);
};

/// Whether messages count when they are admitted to the source queue, not at their generation.
[[nodiscard]] inline bool counts_at_admission(const RunState& run) {
  return run.scenario.wireless.count_at == CountAt::admission;
}

}  // namespace stormproof::model
