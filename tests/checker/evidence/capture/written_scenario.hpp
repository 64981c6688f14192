// Who is who in the capture of a scenario, and how much each participant describes.
#pragma once

#include <cstdint>
#include <vector>

#include "checker/evidence/capture/write/capture_probe.hpp"
#include "checker/evidence/capture/write/identities.hpp"
#include "model/scenario.hpp"

namespace stormproof::capture::testing {

[[nodiscard]] inline bool is_fastdds(const model::Scenario& scenario) {
  return scenario.dds.implementation == model::ImplementationKind::fastdds;
}

[[nodiscard]] inline bool has_server(const model::Scenario& scenario) {
  return is_fastdds(scenario) && (scenario.dds.discovery == model::Discovery::server ||
                                  scenario.dds.discovery == model::Discovery::super_client);
}

[[nodiscard]] inline std::vector<write::Identity> identities(const model::Scenario& scenario) {
  return write::identities(
      scenario.deployment, is_fastdds(scenario) ? fastdds_vendor : simulated_vendor,
      has_server(scenario) ? scenario.dds.discovery : model::Discovery::simple);
}

[[nodiscard]] inline std::uint32_t descriptors_of(const model::Scenario& scenario, std::uint32_t i,
                                                  model::Stream stream) {
  const model::Participant& participant = scenario.deployment.participants[i];
  const model::DescriptorProfile& profile = scenario.dds.descriptors;
  return stream == model::Stream::pub ? profile.default_publications + participant.publications
                                      : profile.default_subscriptions + participant.subscriptions;
}

}  // namespace stormproof::capture::testing
