// A run, and how long its packets take at most.
#pragma once

#include <algorithm>
#include <utility>

#include "model/simulator.hpp"
#include "props/monitors/delay_probe.hpp"

namespace stormproof::calculus {

struct Observed {
  model::Scenario scenario;
  model::RunResult result;
  model::Nanoseconds longest;    ///< delay of a packet
  model::Nanoseconds last_sedp;  ///< when the last DATA, HEARTBEAT or ACKNACK was sent
};

class LastSedp final : public props::DelayProbe {
 public:
  using DelayProbe::DelayProbe;
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override {
    DelayProbe::emitted(packet, source, destinations);
    if (packet.kind == model::PacketKind::data || packet.kind == model::PacketKind::heartbeat ||
        packet.kind == model::PacketKind::acknack) {
      last = now();
    }
  }
  model::Nanoseconds last;
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
  LastSedp probe{run.scenario};
  model::RunOptions options;
  options.probe = &probe;
  options.max_events = 60'000;
  run.result = model::simulate(run.scenario, options);
  run.longest = probe.delays().largest(run.result.end_time);
  run.last_sedp = probe.last;
  return run;
}

}  // namespace stormproof::calculus
