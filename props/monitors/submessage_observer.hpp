// What monitors of Cyclone DDS hear of its packets: each submessage once when its packet is sent,
// however many copies of it are, and each one that a machine takes; and which samples exist and
// have been taken. It is gathered once for all monitors of a run that need it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "model/trace/selection.hpp"
#include "props/monitors/descriptors.hpp"
#include "props/monitors/observer.hpp"
#include "props/monitors/received_submessages.hpp"

namespace stormproof::props {

class SubmessageProbe final : public model::Probe, public model::trace::Selective {
 public:
  /// The states of the machine that takes a submessage.
  struct States {
    std::string_view before;
    std::string_view after;
  };
  class Listener {
   public:
    virtual ~Listener() = default;
    /// A writer has this sample more.
    virtual void created(std::uint32_t /*writer*/, std::uint32_t /*sample*/) {}
    /// A writer has a reader more.
    virtual void matched(std::uint32_t /*relation*/) {}
    /// A reader has a writer more.
    virtual void opened(std::uint32_t /*relation*/) {}
    /// The ACK timer of a reader is about to do what it is for.
    virtual void timer_fired(std::uint32_t /*relation*/) {}
    /// A machine of the relation takes DATA, a HEARTBEAT or an ACKNACK.
    virtual void heard(std::uint32_t /*relation*/, const model::Submessage&, const States&) {}
    virtual void sent(const model::Packet& /*packet*/, const model::Submessage&) {}
  };

  [[nodiscard]] bool gathers_as(const SubmessageProbe&) const { return true; }
  [[nodiscard]] model::Reports reports() const override {
    using enum model::Report;
    model::Reports reports;
    for (const model::Report report : {event_started, received, transition, emitted, looped_back}) {
      reports.set(report);
    }
    return reports;
  }
  [[nodiscard]] model::trace::Selection selection() const override {
    return model::trace::Selection{}.only({model::Report::event_started},
                                          {model::EventKind::endpoint_creation});
  }
  [[nodiscard]] bool wants_single_packets() const override { return false; }
  void listen(Listener& listener) { listeners_.push_back(&listener); }

  void run_started(const model::Topology& topology) override {
    topology_ = &topology;
    received_.reset(topology);
    last_.assign(topology.participant_count(), nullptr);
    samples_.assign(received_.writer_count(), 0);
    taken_.assign(received_.relation_count(), {});
  }
  /// What a participant creates is one sample more of one of its writers.
  void event_started(const model::Event& event) override {
    if (event.kind != model::EventKind::endpoint_creation) return;
    const std::uint32_t writer = received_.writer_of_creation(event);
    const std::uint32_t sample = samples_[writer]++;
    for (Listener* one : listeners_) one->created(writer, sample);
  }
  void received(const model::Packet& packet, std::uint32_t) override { received_.arriving(packet); }
  void transition(const model::Transition& fired) override {
    if (fired.machine.kind != model::MachineRef::Kind::endpoint_relation) return;
    const std::uint32_t relation = fired.machine.subject;
    if (fired.event == "Opened") {
      const bool by_writer = fired.machine.machine == "MatchedReader";
      for (Listener* one : listeners_) by_writer ? one->matched(relation) : one->opened(relation);
    } else if (fired.event == "TimerFired") {
      for (Listener* one : listeners_) one->timer_fired(relation);
    } else if (const auto* taken = received_.heard(fired.machine, fired.event)) {
      if (taken->kind == model::Submessage::Kind::data) taken_[relation].add(taken->sample);
      for (Listener* one : listeners_) one->heard(relation, *taken, {fired.before, fired.after});
    }
  }
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t>) override {
    note(packet, source);
  }
  void looped_back(const model::Packet& packet, std::uint32_t) override {
    note(packet, packet.to_group ? packet.pair : topology_->pair(packet.pair).source);
  }

  [[nodiscard]] const ReceivedSubmessages& numbers() const { return received_; }
  /// How many samples of the writer exist.
  [[nodiscard]] std::uint32_t samples_of(std::uint32_t writer) const { return samples_[writer]; }
  /// Samples that the reader of the relation has taken.
  [[nodiscard]] const Descriptors& taken(std::uint32_t relation) const { return taken_[relation]; }

 private:
  void note(const model::Packet& packet, std::uint32_t source) {
    if (packet.submessages == nullptr || last_[source] == packet.submessages) return;
    last_[source] = packet.submessages;
    for (const model::Submessage& each : *packet.submessages) {
      for (Listener* one : listeners_) one->sent(packet, each);
    }
  }

  const model::Topology* topology_ = nullptr;
  ReceivedSubmessages received_;
  std::vector<std::shared_ptr<const std::vector<model::Submessage>>> last_;  // by source
  std::vector<std::uint32_t> samples_;                                       // by writer
  std::vector<Descriptors> taken_;                                           // by relation
  std::vector<Listener*> listeners_;
};

/// A monitor that needs them.
template <class Base = Observer>
class SubmessageObserver : public Base, private SubmessageProbe::Listener {
 public:
  using Feeder = SubmessageObserver;
  static constexpr bool reads_clock = true;

  explicit SubmessageObserver(std::string_view property) : Base{property} { probe_->listen(*this); }

  void join(model::Company& company) override {
    Base::join(company);
    const auto own = std::exchange(probe_, company.gatherer_like(probe_));
    if (probe_ != own) probe_->listen(*this);
  }
  void run_started(const model::Topology& topology) override {
    Base::run_started(topology);
    if (this->is_alone()) probe_->run_started(topology);
  }
  void event_started(const model::Event& event) override {
    Base::event_started(event);
    if (this->is_alone()) probe_->event_started(event);
  }
  void received(const model::Packet& packet, std::uint32_t receiver) override {
    if (this->is_alone()) probe_->received(packet, receiver);
  }
  void transition(const model::Transition& fired) override {
    if (this->is_alone()) probe_->transition(fired);
  }
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override {
    if (this->is_alone()) probe_->emitted(packet, source, destinations);
  }
  void looped_back(const model::Packet& packet, std::uint32_t receiver) override {
    if (this->is_alone()) probe_->looped_back(packet, receiver);
  }

 protected:
  using States = SubmessageProbe::States;

  [[nodiscard]] const SubmessageProbe& gathered() const { return *probe_; }
  [[nodiscard]] const ReceivedSubmessages& numbers() const { return probe_->numbers(); }
  /// The relation of what a writer sends to one participant.
  [[nodiscard]] std::uint32_t relation_of(const model::Packet& packet,
                                          const model::Submessage& submessage) const {
    return numbers().stride() * packet.pair + submessage.writer;
  }
  /// The relation of what a reader sends to the writer's participant.
  [[nodiscard]] std::uint32_t relation_answered(const model::Packet& packet,
                                                const model::Submessage& submessage) const {
    return numbers().stride() * this->topology().pair(packet.pair).reverse + submessage.writer;
  }

 private:
  std::shared_ptr<SubmessageProbe> probe_ = std::make_shared<SubmessageProbe>();
};

}  // namespace stormproof::props
