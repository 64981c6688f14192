// A simulated run as a capture file in memory: what `stormproof simulate --pcap` writes, for
// callers that read it at once, as a real capture (specs/guide/captures.md, "Simulated captures").
#pragma once

#include <cstdint>
#include <vector>

#include "model/run_result.hpp"
#include "model/scenario.hpp"
#include "model/simulator.hpp"

namespace stormproof::capture {

struct SimulatedCapture {
  std::vector<std::uint8_t> pcap{};  ///< a complete pcap file; `MemoryCapture::content` takes it
  model::RunResult run{};            ///< the run that it shows, from its start to its end
};

/// Runs the scenario, which must be valid (what `read_scenario` accepts is), and captures every
/// packet that leaves a host. Of `options` everything holds: the probe observes, too; the mutation
/// is a deliberate mistake in the rules of the run, whose packets then show it.
[[nodiscard]] SimulatedCapture simulated_capture(const model::Scenario& scenario,
                                                 const model::RunOptions& options = {});

}  // namespace stormproof::capture
