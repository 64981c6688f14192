// The trace of a run: JSON Lines, one line for every processed event, with all that it changed. A
// trace says why a run took as long as it did, it can be searched with jq, and `replay` proves that
// it is right. specs/guide/trace-format.md describes every key.
#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "model/engine/topology.hpp"
#include "model/probe.hpp"
#include "model/run_result.hpp"
#include "model/scenario.hpp"
#include "model/trace/effect_names.hpp"
#include "model/trace/event_subject.hpp"
#include "model/trace/transition_list.hpp"

namespace stormproof::model::trace {

inline constexpr int trace_version = 1;

class TraceWriter final : public Probe {
 public:
  /// Takes one line, which ends in a line feed.
  using Sink = std::function<void(std::string_view line)>;

  /// Writes the header at once. Whether everything could be written is the stream's to say.
  TraceWriter(std::ostream& out, const Scenario& scenario, Effects effects = Effects::left_out);
  TraceWriter(Sink sink, const Scenario& scenario, Effects effects = Effects::left_out);

  /// Writes the last line. Call it once, after the run.
  void finish(const RunResult& result);

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
  void source_completed(const Packet& packet) override;
  void arrived(const Packet& packet, bool lost) override;
  void received(const Packet& packet, std::uint32_t receiver) override;
  void looped_back(const Packet& packet, std::uint32_t receiver) override;

 private:
  /// The fragment that a channel serves, or the fragments of a unit, as elements of an array.
  struct Serving {
    std::uint64_t packet = 0;
    std::uint32_t fragment = 0;
    std::uint32_t stage = 0;
    std::string unit;
  };

  void append_generated(const Packet& packet);
  /// Of what happens to one packet in an event, or to some of a unit.
  void append_whole_or_list(const char* key, const std::string& elements);
  void append_event_subject();
  void append_subject(Subject kind, std::uint32_t subject);
  void append_cause();
  void append_effects();
  /// The effect that sends a packet, as the last key of its object.
  void append_effect(std::string& out) const;
  void append_transitions();
  void append_serving(std::string& out, const Serving& serving) const;

  Sink sink_;
  bool by_unit_;  // several packets can leave their sources, and arrive, in one event
  std::vector<std::string> channels_;  // as JSON strings, by number
  std::vector<std::string> stages_;
  std::vector<HostId> hosts_;           // by participant
  const Topology* topology_ = nullptr;  // of the run
  std::uint64_t next_number_ = 0;
  std::unordered_map<std::uint64_t, std::uint64_t> causes_;  // insertion → event, while scheduled
  std::vector<Serving> serving_;                             // by channel
  std::vector<std::vector<std::uint64_t>> generated_;        // by relation: descriptors sent so far
  std::optional<EffectNames> effect_names_;                  // if they are wanted
  std::string line_;

  // The event that is being processed, and what it has caused so far.
  Event event_;
  bool in_event_ = false;
  TransitionList transitions_;
  std::string emitted_;  // elements of arrays, or empty
  std::string looped_back_;
  std::string service_;  // objects, or empty
  std::string dropped_;
  std::string arrived_;
  std::string received_;
  std::string left_source_;  // packet numbers, or empty
  std::string packet_;
  std::string effects_;  // elements of an array, or empty
};

}  // namespace stormproof::model::trace
