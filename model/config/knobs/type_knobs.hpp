// The table of types that participants do not know (`deployment.types`), and its rules. See
// knobs.hpp for what visits them.
#pragma once

#include <algorithm>

#include <fmt/core.h>

#include "model/config/knobs/knobs.hpp"
#include "model/config/knobs/value_types.hpp"
#include "model/fastdds/endpoints.hpp"
#include "model/fastdds/types.hpp"
#include "model/implementations.hpp"
#include "model/scenario.hpp"

namespace stormproof::model::config {

inline constexpr std::string_view types_key = "deployment.types";
/// A DATA submessage with questions or answers has no more: it is never split.
inline constexpr std::int64_t most_sample_bytes = 65'000;

void visit_knobs(auto& visit, Is<EndpointTypes> auto& types) {
  visit.knob("unknown_per_participant", types.unknown_per_participant,
             count_range(0, Deployment::max_endpoints),
             "so many endpoints of each participant have a type that nobody else knows: requests "
             "and replies of its services in turn, then user publications, then user "
             "subscriptions");
}

/// A sample that is lost nobody repeats here, as Fast DDS would, so nothing may be.
[[nodiscard]] inline bool loses_nothing(const Scenario& scenario) {
  return scenario.wireless.lost_packets.empty() && !scenario.wireless.loss &&
         !queues_drop(scenario.wireless) && !(scenario.vary && scenario.vary->loss);
}

void visit_types(auto& visit, Is<Scenario> auto& scenario) {
  if (!scenario.deployment.types) return;
  const ImplementationTraits& traits = traits_of(scenario.dds);
  visit.rule(traits.creates_endpoints_over_time && !traits.has_server && !traits.has_own_timers,
             types_key,
             "no types, or a DDS profile with implementation: fastdds and no Discovery Server");
  visit.rule(!scenario.deployment.life && !(scenario.vary && scenario.vary->outages) &&
                 !(scenario.vary && scenario.vary->restarts),
             types_key,
             "no types where participants fail or come back (deployment.life, vary.outages, "
             "vary.restarts)");
  visit.rule(loses_nothing(scenario), types_key,
             "no types where packets are lost (wireless.lost_packets, wireless.loss, "
             "wireless.queue, vary.loss)");
  const std::size_t all = fastdds::most_types(*scenario.deployment.types);
  const std::int64_t bytes = fastdds::largest_sample_bytes(scenario.dds, all);
  visit.rule(
      scenario.dds.version.typelookup_unit != LookupUnit::participant || bytes <= most_sample_bytes,
      "dds.typelookup_unit",
      fmt::format("type_and_stream or type: an answer about {} types would have {} bytes, "
                  "more than {}",
                  all, bytes, most_sample_bytes));
  std::uint64_t most = Deployment::max_endpoints;
  for (const Participant& participant : scenario.deployment.participants) {
    most = std::min(most, fastdds::endpoints_with_own_types(participant));
  }
  visit.rule(scenario.deployment.types->unknown_per_participant <= most,
             "deployment.types.unknown_per_participant",
             fmt::format("at most {}: 12 requests and replies, and the user endpoints of each "
                         "participant",
                         most));
}

}  // namespace stormproof::model::config
