// Observations that are not what happened, for mistakes that only an observer of a run can notice.
#pragma once

#include <functional>

#include "model/engine/packet.hpp"
#include "props/laws/law.hpp"
#include "tests/props/laws/law_check.hpp"

namespace stormproof::props {

/// Tells another observer all that happens; mistakes leave something out.
class Forwarding : public model::Probe {
 public:
  explicit Forwarding(model::Probe& to) : to_{to} {}

  void run_started(const model::Topology& topology) override { to_.run_started(topology); }
  void event_started(const model::Event& event) override { to_.event_started(event); }
  void event_finished(const model::Depths& depths) override { to_.event_finished(depths); }
  void transition(const model::Transition& fired) override { to_.transition(fired); }
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override {
    to_.emitted(packet, source, destinations);
  }
  void looped_back(const model::Packet& packet, std::uint32_t receiver) override {
    to_.looped_back(packet, receiver);
  }
  void received(const model::Packet& packet, std::uint32_t receiver) override {
    to_.received(packet, receiver);
  }

 private:
  model::Probe& to_;
};

/// States change although no packet came.
class WithoutReceptions final : public Forwarding {
 public:
  using Forwarding::Forwarding;
  void received(const model::Packet&, std::uint32_t) override {}
};

/// A policy that has cycles, but asks every reader.
class ExpiriesAreCycles final : public Forwarding {
 public:
  using Forwarding::Forwarding;
  void event_started(const model::Event& event) override {
    model::Event cycle = event;
    if (cycle.kind == model::EventKind::heartbeat_expiry)
      cycle.kind = model::EventKind::cycle_start;
    Forwarding::event_started(cycle);
  }
};

template <class Observation>
Simulate observed_as(std::function<void(model::Scenario&)> change = [](model::Scenario&) {}) {
  return [change](const model::Scenario& scenario, model::Probe* probe) {
    model::Scenario other = scenario;
    change(other);
    if (probe == nullptr) return correct(other, nullptr);
    Observation observation{*probe};
    return correct(other, &observation);
  };
}

}  // namespace stormproof::props
