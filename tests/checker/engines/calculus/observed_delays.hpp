// A run, and how long its packets take at most.
#pragma once

#include <algorithm>
#include <utility>

#include "model/engine/packet.hpp"
#include "model/simulator.hpp"
#include "props/monitors/delay_meter.hpp"

namespace stormproof::calculus {

struct Observed {
  model::Scenario scenario;
  model::RunResult result;
  model::Nanoseconds longest;    ///< delay of a packet
  model::Nanoseconds last_sedp;  ///< when the last DATA, HEARTBEAT or ACKNACK was sent
};

class DelayProbe final : public model::Probe {
 public:
  explicit DelayProbe(const model::Scenario& scenario) : meter{scenario} {}
  void run_started(const model::Topology& topology) override { topology_ = &topology; }
  void event_started(const model::Event& event) override { now_ = event.time; }
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    meter.emitted(packet, now_);
    if (packet.kind == model::PacketKind::data || packet.kind == model::PacketKind::heartbeat ||
        packet.kind == model::PacketKind::acknack) {
      last_sedp = now_;
    }
  }
  void arrived(const model::Packet& packet, bool lost) override { meter.arrived(packet, lost); }
  void received(const model::Packet& packet, std::uint32_t receiver) override {
    meter.received(*topology_, packet, receiver, now_);
  }
  props::DelayMeter meter;
  model::Nanoseconds last_sedp;

 private:
  const model::Topology* topology_ = nullptr;
  model::Nanoseconds now_;
};

/// Goes on until long after discovery, and `more`, but not for ever.
inline Observed run_of(model::Scenario scenario, model::Nanoseconds delay,
                       model::Nanoseconds more = {}) {
  const model::SedpProfile& sedp = scenario.dds.sedp;
  model::Nanoseconds latest;
  for (const model::Participant& p : scenario.deployment.participants) {
    latest = std::max(latest, p.endpoints_done);
  }
  scenario.time_limit = latest + delay * 6 + sedp.heartbeat_period * 3 +
                        sedp.heartbeat_response_delay * 3 + scenario.dds.spdp.startup_period * 2 +
                        more;
  Observed run{std::move(scenario), {}, {}, {}};
  DelayProbe probe{run.scenario};
  model::RunOptions options;
  options.probe = &probe;
  options.max_events = 60'000;
  run.result = model::simulate(run.scenario, options);
  run.longest = probe.meter.largest(run.result.end_time);
  run.last_sedp = probe.last_sedp;
  return run;
}

}  // namespace stormproof::calculus
