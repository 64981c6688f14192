// Endpoints that participants create over time.
#include "model/engine/endpoint_creations.hpp"

namespace stormproof::model {

Endpoint creation_of(const Topology& topology, std::uint32_t i, std::uint32_t k) {
  return creation_order(k, topology.descriptor_count(i, Stream::pub) - default_publications);
}

void schedule_creations(RunState& run, std::uint32_t i, Nanoseconds start) {
  const Participant& participant = run.scenario.deployment.participants[i];
  const std::int64_t span = (participant.endpoints_done - participant.start).count();
  const std::int64_t endpoints =
      run.topology.descriptor_count(i, Stream::pub) + run.topology.descriptor_count(i, Stream::sub);
  for (std::int64_t k = 0; k < endpoints; ++k) {
    run.schedule(start + Nanoseconds{span * (k + 1) / endpoints}, EventKind::endpoint_creation, i,
                 static_cast<std::uint32_t>(k));
  }
}

}  // namespace stormproof::model
