// Several observers of one run, as one. They hear of everything in the order in which they were
// added.
#pragma once

#include <algorithm>
#include <vector>

#include "model/probe.hpp"

namespace stormproof::model::trace {

class ProbeList final : public Probe {
 public:
  /// The probe must outlive this list.
  void add(Probe& probe) { probes_.push_back(&probe); }
  [[nodiscard]] bool empty() const { return probes_.empty(); }

  void run_started(const Topology& topology) override {
    for (Probe* probe : probes_) probe->run_started(topology);
  }
  void event_started(const Event& event) override {
    for (Probe* probe : probes_) probe->event_started(event);
  }
  void event_finished(const Depths& depths) override {
    for (Probe* probe : probes_) probe->event_finished(depths);
  }
  void transition(const MachineRef& machine, std::string_view event, std::string_view before,
                  std::string_view after, std::uint32_t first_word,
                  std::uint64_t descriptors) override {
    for (Probe* probe : probes_) {
      probe->transition(machine, event, before, after, first_word, descriptors);
    }
  }
  [[nodiscard]] bool wants_effects() const override {
    return std::ranges::any_of(probes_, &Probe::wants_effects);
  }
  void effect(fsm::composition::EffectKey key) override {
    for (Probe* probe : probes_) probe->effect(key);
  }
  void scheduled(std::uint64_t insertion, Nanoseconds time, EventKind kind,
                 std::uint32_t subject) override {
    for (Probe* probe : probes_) probe->scheduled(insertion, time, kind, subject);
  }
  void rescheduled(const Event& event, std::uint64_t insertion) override {
    for (Probe* probe : probes_) probe->rescheduled(event, insertion);
  }
  void emitted(const Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override {
    for (Probe* probe : probes_) probe->emitted(packet, source, destinations);
  }
  void service_started(std::uint32_t channel, std::uint32_t stage, const Packet& packet,
                       std::uint32_t fragment, Nanoseconds until) override {
    for (Probe* probe : probes_) probe->service_started(channel, stage, packet, fragment, until);
  }
  void source_completed(const Packet& packet) override {
    for (Probe* probe : probes_) probe->source_completed(packet);
  }
  void arrived(const Packet& packet, bool lost) override {
    for (Probe* probe : probes_) probe->arrived(packet, lost);
  }
  void received(const Packet& packet, std::uint32_t receiver) override {
    for (Probe* probe : probes_) probe->received(packet, receiver);
  }
  void looped_back(const Packet& packet, std::uint32_t receiver) override {
    for (Probe* probe : probes_) probe->looped_back(packet, receiver);
  }
  void backlog_changed(std::uint32_t participant, std::uint64_t packets,
                       std::int64_t admitted_bytes) override {
    for (Probe* probe : probes_) probe->backlog_changed(participant, packets, admitted_bytes);
  }
  void waiting_changed(std::uint32_t channel, std::uint64_t fragments) override {
    for (Probe* probe : probes_) probe->waiting_changed(channel, fragments);
  }

 private:
  std::vector<Probe*> probes_;
};

}  // namespace stormproof::model::trace
