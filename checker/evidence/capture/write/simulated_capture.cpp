// A run with two observers.
#include "checker/evidence/capture/write/simulated_capture.hpp"

#include "checker/evidence/capture/write/capture_probe.hpp"
#include "model/trace/probe_list.hpp"

namespace stormproof::capture {

SimulatedCapture simulated_capture(const model::Scenario& scenario,
                                   const model::RunOptions& options) {
  SimulatedCapture result;
  CaptureProbe capture{
      [&result](Bytes bytes) { result.pcap.insert(result.pcap.end(), bytes.begin(), bytes.end()); },
      scenario};
  model::trace::ProbeList probes;
  if (options.probe != nullptr) probes.add(*options.probe);
  probes.add(capture);
  model::RunOptions observed = options;
  observed.probe = &probes;
  result.run = model::simulate(scenario, observed);
  return result;
}

}  // namespace stormproof::capture
