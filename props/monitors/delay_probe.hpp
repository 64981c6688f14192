// A probe that measures the delays of a run, for whoever wants nothing else of it, and once for all
// monitors of the run that need them (delay_observer.hpp).
#pragma once

#include "model/engine/packet.hpp"
#include "model/engine/topology.hpp"
#include "props/monitors/delay_meter.hpp"

namespace stormproof::props {

class DelayProbe : public model::Probe {
 public:
  explicit DelayProbe(const model::Scenario& scenario) : delays_{scenario} {}

  void join(model::Company& company) override { clock_ = company.clock; }
  /// Whether the other one measures the same of every run.
  [[nodiscard]] bool gathers_as(const DelayProbe& other) const {
    return delays_.measures_as(other.delays_);
  }
  [[nodiscard]] model::Reports reports() const override {
    using model::Report;
    model::Reports reports;
    reports.set(Report::event_started, clock_ == own_);
    for (const Report report : {Report::emitted, Report::arrived, Report::received}) {
      reports.set(report);
    }
    return reports;
  }
  [[nodiscard]] bool wants_single_packets() const override { return false; }
  void run_started(const model::Topology& topology) override { topology_ = &topology; }
  void event_started(const model::Event& event) override { own_->begin(event); }
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    delays_.emitted(packet, now());
  }
  void arrived(const model::Packet& packet, bool lost) override { delays_.arrived(packet, lost); }
  void received(const model::Packet& packet, std::uint32_t receiver) override {
    delays_.received(*topology_, packet, receiver, now());
  }

  [[nodiscard]] const DelayMeter& delays() const { return delays_; }
  [[nodiscard]] DelayMeter& delays() { return delays_; }

 protected:
  [[nodiscard]] model::Nanoseconds now() const { return clock_->now; }

 private:
  const model::Topology* topology_ = nullptr;
  const std::shared_ptr<model::RunClock> own_ = std::make_shared<model::RunClock>();
  std::shared_ptr<const model::RunClock> clock_ = own_;
  DelayMeter delays_;
};

}  // namespace stormproof::props
