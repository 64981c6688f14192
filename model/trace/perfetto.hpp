// The run as a timeline for ui.perfetto.dev: what each channel serves and for whom, what each
// participant sends and receives, how long its backlog is, and arrows that follow a packet from its
// sender over the channel to its receiver and a timer from its start to its end.
// specs/guide/trace-format.md says how to read it.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "model/airtime.hpp"
#include "model/engine/topology.hpp"
#include "model/probe.hpp"
#include "model/scenario.hpp"
#include "model/trace/effect_names.hpp"
#include "model/trace/perfetto_events.hpp"
#include "model/trace/transition_list.hpp"

namespace stormproof::model::trace {

class PerfettoWriter final : public Probe {
 public:
  PerfettoWriter(std::ostream& out, const Scenario& scenario, Effects effects = Effects::left_out);

  /// Completes the document, after the run and however it ended. Call it once.
  void finish();

  void run_started(const Topology& topology) override;
  void event_started(const Event& event) override;
  void event_finished(const Depths& depths) override;
  [[nodiscard]] bool wants_effects() const override { return effect_names_.has_value(); }
  void effect(fsm::composition::EffectKey key) override;
  void transition(const Transition& fired) override;
  void scheduled(std::uint64_t insertion, Nanoseconds time, EventKind kind,
                 std::uint32_t subject) override;
  void rescheduled(const Event& event, std::uint64_t insertion) override;
  void emitted(const Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override;
  void service_started(std::uint32_t channel, std::uint32_t stage, const Packet& packet,
                       std::uint32_t fragment, Nanoseconds until) override;
  void dropped(std::uint32_t channel, std::uint32_t stage, const Packet& packet,
               std::uint32_t fragment) override;
  void arrived(const Packet& packet, bool lost) override;
  void received(const Packet& packet, std::uint32_t receiver) override;
  void backlog_changed(std::uint32_t participant, std::uint64_t packets,
                       std::int64_t admitted_bytes) override;
  void waiting_changed(std::uint32_t channel, std::uint64_t fragments) override;

 private:
  /// What one event does on one row. It takes no time, so the slice has none.
  struct Slice {
    Track track;
    std::string name;
    std::string args;
    std::vector<Flow> flows;
  };
  /// Where the slice of a row is, if the row has one in this event.
  struct Place {
    std::uint64_t event = 0;
    std::size_t slice = 0;
  };
  /// A number that is written when it has changed.
  struct Counter {
    std::uint64_t value = 0;
    std::int64_t bytes = 0;
    bool changed = false;
  };

  /// The slice of the current event on this row; a new one gets this name.
  Slice& slice_on(Track track, std::string_view name);
  static void add_packet(Slice& slice, const Packet& packet);
  void add_transitions();
  /// Leads the arrow of the multicast that arrives to everybody whom it is news to.
  void end_multicast_flow();
  void write_slices();
  void write_counters();

  PerfettoEvents events_;
  Fragmentation fragmentation_;
  std::vector<std::string> channels_;
  std::vector<std::string> stages_;     // as JSON strings
  std::vector<HostId> hosts_;           // by participant
  const Topology* topology_ = nullptr;  // of the run
  std::vector<std::uint32_t> serving_;  // by channel: how many slices are open
  std::vector<Counter> waiting_;        // by channel
  std::vector<Counter> backlog_;        // by participant
  std::vector<std::uint32_t> backlogs_changed_;
  std::uint64_t missing_ = 0;
  bool missing_changed_ = false;
  std::uint64_t scheduled_before_run_ = 0;
  std::unordered_map<std::uint64_t, std::uint64_t> first_insertions_;  // of rescheduled timers
  std::optional<EffectNames> effect_names_;                            // if they are wanted

  // The event that is being processed.
  Nanoseconds now_;
  bool in_event_ = false;
  std::uint64_t event_count_ = 0;  // events so far, this one included
  std::vector<Slice> slices_;      // those from `used_` on keep their memory
  std::size_t used_ = 0;
  std::vector<Place> places_;  // by thread number
  TransitionList transitions_;
  struct Multicast {
    std::uint64_t packet = 0;
    std::uint32_t source = 0;
  };
  std::optional<Multicast> multicast_;   // that arrives
  std::vector<std::uint32_t> informed_;  // participants that it is news to
};

}  // namespace stormproof::model::trace
