// A probe that measures the delays of a run, for whoever wants nothing else of it.
#pragma once

#include "model/engine/packet.hpp"
#include "model/engine/topology.hpp"
#include "props/monitors/delay_meter.hpp"

namespace stormproof::props {

class DelayProbe : public model::Probe {
 public:
  explicit DelayProbe(const model::Scenario& scenario) : delays_{scenario} {}

  void run_started(const model::Topology& topology) override { topology_ = &topology; }
  void event_started(const model::Event& event) override { now_ = event.time; }
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    delays_.emitted(packet, now_);
  }
  void arrived(const model::Packet& packet, bool lost) override { delays_.arrived(packet, lost); }
  void received(const model::Packet& packet, std::uint32_t receiver) override {
    delays_.received(*topology_, packet, receiver, now_);
  }

  [[nodiscard]] const DelayMeter& delays() const { return delays_; }

 protected:
  [[nodiscard]] model::Nanoseconds now() const { return now_; }

 private:
  const model::Topology* topology_ = nullptr;
  model::Nanoseconds now_;
  DelayMeter delays_;
};

}  // namespace stormproof::props
