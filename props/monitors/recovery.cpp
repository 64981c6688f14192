// live.recovery: from the last failure of a run on (a lost packet, the end of an outage, a start or
// return), everything has to be complete within the bound. What a silent participant lacks, and
// what others lack of it, is not asked for. The event that the monitor objects to is the last one
// that had to do with what is missing: after it there is silence, or waiting.
#include <algorithm>
#include <bit>
#include <optional>
#include <vector>

#include <fmt/core.h>

#include "model/implementations.hpp"
#include "model/life.hpp"
#include "model/trace/event_subject.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/observer.hpp"
#include "props/monitors/received_descriptors.hpp"
#include "props/monitors/recovery_as_counted.hpp"
#include "props/monitors/recovery_observer.hpp"

namespace stormproof::props {

namespace {

class Recovery : public RecoveryObserver {
 public:
  Recovery(const model::Scenario& scenario, std::optional<model::Nanoseconds> bound)
      : RecoveryObserver{scenario, bound},
        life_{scenario.deployment.life.value_or(model::Life{})} {}

  void run_started(const model::Topology& topology) override {
    Observer::run_started(topology);
    received_.reset(topology);
    names_.emplace(topology);
    relations_.assign(topology.relation_count(), {});
    for (std::uint32_t r = 0; r < topology.relation_count(); ++r) {
      if (is_asked_for(topology.pair(r / 2))) relations_[r].missing = topology.descriptor_count(r);
      if (lives(topology.pair(r / 2)) && has_all(topology.pair(r / 2))) begin_with_all(r);
    }
  }
  void event_started(const model::Event& event) override {
    RecoveryObserver::event_started(event);
    if (model::trace::subject_of(event.kind) == model::trace::Subject::relation) {
      touch(event.subject);
    }
  }
  void transition(const model::Transition& fired) override {
    if (const model::Packet* data = received_.taken(fired.machine, fired.event)) take(*data);
    if (received_.is_new(fired.machine, fired.event)) lose(fired.machine.subject);
    if (fired.machine.kind == model::MachineRef::Kind::relation) touch(fired.machine.subject);
  }
  void received(const model::Packet& packet, std::uint32_t receiver) override {
    DelayObserver::received(packet, receiver);
    received_.arriving(packet);
  }
  void arrived(const model::Packet& packet, bool lost) override {
    RecoveryObserver::arrived(packet, lost);
    const bool is_of_relation = packet.kind == model::PacketKind::data ||
                                packet.kind == model::PacketKind::heartbeat ||
                                packet.kind == model::PacketKind::acknack;
    if (is_of_relation) touch(packet.relation());
  }

 protected:
  [[nodiscard]] bool is_missing_something() const override {
    return std::ranges::any_of(relations_, [](const Relation& r) { return r.missing > 0; });
  }
  void complain(model::Nanoseconds due) override {
    const auto missing =
        std::ranges::find_if(relations_, [](const Relation& r) { return r.missing > 0; });
    const auto number = static_cast<std::uint32_t>(missing - relations_.begin());
    object(missing->event, missing->time,
           fmt::format("Nothing more happens there until {}: {} descriptor{} of {} {} still "
                       "missing, and nothing has failed since {}.",
                       time_text(due), missing->missing, missing->missing == 1 ? "" : "s",
                       relation_text(*names_, number), missing->missing == 1 ? "is" : "are",
                       time_text(failed())));
  }

 private:
  struct Relation {
    std::uint64_t missing = 0;
    std::uint64_t event = 0;  ///< the last that had to do with it, while something was missing
    model::Nanoseconds time;
  };

  [[nodiscard]] bool is_asked_for(const model::Pair& pair) const {
    return lives(pair) && !has_all(pair);
  }
  [[nodiscard]] bool lives(const model::Pair& pair) const {
    const auto is_silent = [&](const model::Mute& mute) {
      return mute.participant == pair.source || mute.participant == pair.destination;
    };
    return pair.cross_host && !is_replaced(life_, pair.source) &&
           !is_replaced(life_, pair.destination) && std::ranges::none_of(life_.mute, is_silent);
  }
  /// Who is believed to have everything of the other has, before the run, all of that other one.
  [[nodiscard]] bool has_all(const model::Pair& pair) const {
    return std::ranges::any_of(life_.stale, [&](const model::StaleRelation& stale) {
      return stale.writer == pair.destination && stale.reader == pair.source;
    });
  }
  /// It lacks only what the other one creates in the run.
  void begin_with_all(std::uint32_t relation) {
    const model::Stream s = relation % 2 == 0 ? model::Stream::pub : model::Stream::sub;
    const std::uint32_t source = topology().pair(relation / 2).source;
    const std::uint32_t late = late_descriptors(life_, source, s);
    model::DescriptorSet had;
    for (std::uint32_t k = 0; k < received_.word_count(relation); ++k) {
      had.add(k, model::bits_below(topology().descriptor_count(relation) - late, k));
    }
    received_.take(relation, had);
    relations_[relation].missing = late;
  }
  void touch(std::uint32_t relation) {
    Relation& r = relations_[relation];
    if (r.missing == 0 || events() == 0) return;
    r.event = event();
    r.time = now();
  }
  void take(const model::Packet& data) {
    touch(data.relation());
    received_.take(data);
    std::uint64_t& missing = relations_[data.relation()].missing;
    if (missing == 0) return;
    std::uint64_t has = 0;
    for (std::uint32_t k = 0; k < received_.word_count(data.relation()); ++k) {
      has += static_cast<std::uint64_t>(std::popcount(received_.word(data.relation(), k)));
    }
    missing = topology().descriptor_count(data.relation()) - has;
  }
  void lose(std::uint32_t relation) {
    received_.lose(relation);
    if (!is_asked_for(topology().pair(relation / 2))) return;
    relations_[relation].missing = topology().descriptor_count(relation);
    touch(relation);
  }

  const model::Life life_;
  ReceivedDescriptors received_;
  std::optional<model::Topology> names_;  ///< also after the run
  std::vector<Relation> relations_;
};

}  // namespace

MonitorPtr watch_recovery(const model::Scenario& scenario,
                          std::optional<model::Nanoseconds> bound) {
  const model::ImplementationTraits& traits = model::traits_of(scenario.dds);
  if (traits.has_event_thread || traits.has_server) {
    return watch_recovery_as_counted(scenario, bound);
  }
  return attentive<Recovery>(scenario, bound);
}

}  // namespace stormproof::props
