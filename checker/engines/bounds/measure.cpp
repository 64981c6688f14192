// One run with a probe that measures delays.
#include "checker/engines/bounds/measure.hpp"

#include "model/engine/packet.hpp"
#include "model/engine/topology.hpp"
#include "model/simulator.hpp"
#include "props/monitors/delay_meter.hpp"

namespace stormproof::exact {

namespace {

class MeasuringProbe final : public model::Probe {
 public:
  explicit MeasuringProbe(const model::Scenario& scenario) : delays{scenario} {}

  void run_started(const model::Topology& topology) override { topology_ = &topology; }
  void event_started(const model::Event& event) override { now_ = event.time; }
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    delays.emitted(packet, now_);
  }
  void arrived(const model::Packet& packet, bool lost) override { delays.arrived(packet, lost); }
  void received(const model::Packet& packet, std::uint32_t receiver) override {
    delays.received(*topology_, packet, receiver, now_);
  }

  props::DelayMeter delays;

 private:
  const model::Topology* topology_ = nullptr;
  model::Nanoseconds now_;
};

}  // namespace

Measured measure(const model::Scenario& scenario, const checker::CheckRequest& request) {
  model::Scenario run = scenario;
  run.run_until = model::RunUntil::completion;
  MeasuringProbe probe{run};
  model::RunOptions options;
  options.probe = &probe;
  options.on_progress = [&](const model::Progress&) {
    return !request.on_progress || request.on_progress("measuring delays");
  };
  const model::RunResult result = model::simulate(run, options);
  Measured measured;
  measured.largest_delay = probe.delays.largest(result.end_time);
  measured.largest_received_delay = probe.delays.largest_received();
  measured.largest_initial_data_delay = probe.delays.largest_initial_data();
  measured.lost = probe.delays.lost();
  measured.t_disc = result.discovery_time;
  measured.end_time = result.end_time;
  measured.events = result.events;
  measured.initial_data = result.counts.initial_data;
  measured.repair_data = result.counts.repair_data;
  return measured;
}

}  // namespace stormproof::exact
