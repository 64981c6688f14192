// Several observers of one run, as one. They hear of everything in the order in which they were
// added; each only of what it wants to hear of, and of the kinds that it selects (selection.hpp).
// The clock is the list's, and so is what gathers facts for several of them.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "model/engine/packet.hpp"
#include "model/probe.hpp"
#include "model/trace/selection.hpp"

namespace stormproof::model::trace {

class ProbeList final : public Probe {
 public:
  /// The probe must outlive this list.
  void add(Probe& probe) {
    const std::size_t known = company_.gatherers.size();
    probe.join(company_);
    for (std::size_t k = known; k < company_.gatherers.size(); ++k) {
      company_.gatherers[k]->join(company_);
      tell(*company_.gatherers[k]);
    }
    tell(probe);
  }
  [[nodiscard]] bool empty() const { return probes_.empty(); }

  [[nodiscard]] Reports reports() const override { return reports_; }
  [[nodiscard]] bool wants_single_packets() const override { return wants_single_packets_; }
  void run_started(const Topology& topology) override {
    sort_by_kind();
    for (Probe* probe : probes_) probe->run_started(topology);
  }
  void event_started(const Event& event) override {
    clock_->begin(event);
    for (Probe* probe : who_hears(Report::event_started, event.kind)) probe->event_started(event);
  }
  void event_finished(const Depths& depths) override {
    for (Probe* probe : who_hears(Report::event_finished)) probe->event_finished(depths);
  }
  void transition(const Transition& fired) override {
    for (Probe* probe : who_hears(report_of(fired))) {
      probe->transition(fired);
    }
  }
  [[nodiscard]] bool wants_effects() const override {
    return std::ranges::any_of(probes_, &Probe::wants_effects);
  }
  void effect(fsm::composition::EffectKey key) override {
    for (Probe* probe : who_hears(Report::effect)) probe->effect(key);
  }
  void decided(fsm::composition::EffectKey key, bool holds) override {
    for (Probe* probe : who_hears(Report::effect)) probe->decided(key, holds);
  }
  void scheduled(std::uint64_t insertion, Nanoseconds time, EventKind kind,
                 std::uint32_t subject) override {
    for (Probe* probe : who_hears(Report::scheduled, kind))
      probe->scheduled(insertion, time, kind, subject);
  }
  void rescheduled(const Event& event, std::uint64_t insertion) override {
    for (Probe* probe : who_hears(Report::rescheduled)) probe->rescheduled(event, insertion);
  }
  void emitted(const Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override {
    for (Probe* probe : who_hears(Report::emitted, packet.kind))
      probe->emitted(packet, source, destinations);
  }
  void service_started(std::uint32_t channel, std::uint32_t stage, const Packet& packet,
                       std::uint32_t fragment, Nanoseconds until) override {
    for (Probe* probe : who_hears(Report::service_started))
      probe->service_started(channel, stage, packet, fragment, until);
  }
  void dropped(std::uint32_t channel, std::uint32_t stage, const Packet& packet,
               std::uint32_t fragment) override {
    for (Probe* probe : who_hears(Report::dropped))
      probe->dropped(channel, stage, packet, fragment);
  }
  void source_completed(const Packet& packet) override {
    for (Probe* probe : who_hears(Report::source_completed, packet.kind))
      probe->source_completed(packet);
  }
  void arrived(const Packet& packet, bool lost) override {
    for (Probe* probe : who_hears(Report::arrived, packet.kind)) probe->arrived(packet, lost);
  }
  void received(const Packet& packet, std::uint32_t receiver) override {
    for (Probe* probe : who_hears(Report::received, packet.kind)) probe->received(packet, receiver);
  }
  void looped_back(const Packet& packet, std::uint32_t receiver) override {
    for (Probe* probe : who_hears(Report::looped_back, packet.kind))
      probe->looped_back(packet, receiver);
  }
  void backlog_changed(std::uint32_t participant, std::uint64_t packets,
                       std::int64_t admitted_bytes) override {
    for (Probe* probe : who_hears(Report::backlog_changed))
      probe->backlog_changed(participant, packets, admitted_bytes);
  }
  void waiting_changed(std::uint32_t channel, std::uint64_t fragments) override {
    for (Probe* probe : who_hears(Report::waiting_changed))
      probe->waiting_changed(channel, fragments);
  }

 private:
  void tell(Probe& probe) {
    probes_.push_back(&probe);
    const Reports wanted = probe.reports();
    wants_single_packets_ =
        wants_single_packets_ || (wanted.tell_packets_apart() && probe.wants_single_packets());
    wanted_.push_back(wanted);
    for (std::size_t k = 0; k < report_count; ++k) {
      if (wanted.has(static_cast<Report>(k))) who_hears_[k].push_back(&probe);
    }
    reports_.set(Report::event_started);  // the clock goes
    reports_.add(wanted);
  }
  [[nodiscard]] const std::vector<Probe*>& who_hears(Report report) const {
    return who_hears_[static_cast<std::size_t>(report)];
  }
  /// Of this kind of event or packet.
  template <class Kind>
  [[nodiscard]] std::span<Probe* const> who_hears(Report report, Kind kind) const {
    const Range& range = of_kind_[static_cast<std::size_t>(report)][static_cast<std::size_t>(kind)];
    return {sorted_.data() + range.begin, range.size};
  }
  void sort_by_kind() {
    constexpr std::array reports{Report::event_started,    Report::scheduled, Report::emitted,
                                 Report::source_completed, Report::arrived,   Report::received,
                                 Report::looped_back};
    std::vector<Selection> selections;
    for (const Probe* probe : probes_) {
      const auto* selective = dynamic_cast<const Selective*>(probe);
      selections.push_back(selective != nullptr ? selective->selection() : Selection{});
    }
    sorted_.clear();
    for (const Report report : reports) {
      const bool of_event = report == Report::event_started || report == Report::scheduled;
      for (std::size_t kind = 0; kind < (of_event ? event_kind_count : packet_kind_count); ++kind) {
        Range& range = of_kind_[static_cast<std::size_t>(report)][kind];
        range.begin = static_cast<std::uint32_t>(sorted_.size());
        for (std::size_t k = 0; k < probes_.size(); ++k) {
          const bool hears = wanted_[k].has(report) && selections[k].has(report, kind);
          if (hears) sorted_.push_back(probes_[k]);
        }
        range.size = static_cast<std::uint32_t>(sorted_.size()) - range.begin;
      }
    }
  }

  static constexpr std::size_t most_kinds = std::max(event_kind_count, packet_kind_count);
  /// Of `sorted_`.
  struct Range {
    std::uint32_t begin = 0;
    std::uint32_t size = 0;
  };

  std::shared_ptr<RunClock> clock_ =
      std::make_shared<RunClock>();  // probes read it at the end, too
  Company company_{clock_, {}};
  Reports reports_;
  bool wants_single_packets_ = false;
  std::vector<Probe*> probes_;
  std::vector<Reports> wanted_;  // by each of them
  std::array<std::vector<Probe*>, report_count> who_hears_;
  std::array<std::array<Range, most_kinds>, report_count> of_kind_{};
  std::vector<Probe*> sorted_;  // those of one kind together
};

}  // namespace stormproof::model::trace
