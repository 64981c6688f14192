// The processors of a deployment whose participants start one after the other, if it does not say
// any: a newcomer's requests are answered one after the other then, while a program that takes no
// time answers all of them at once and repairs several times as often (specs/guide/fleet.md).
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "model/implementations.hpp"
#include "model/scenario.hpp"

namespace stormproof::trials {

/// The shipped profile, whose times were measured.
inline constexpr const char* usual_hosts = "live-bed-processors";

/// Whether a scenario says no hosts and can have some.
[[nodiscard]] inline bool lacks_hosts(const model::Scenario& scenario) {
  return !scenario.hosts && !scenario.deployment.life &&
         model::traits_of(scenario.dds).has_processor_times;
}
/// Whether somebody is to start when somebody else already has all its endpoints; start times that
/// are drawn are those of programs that are started at once.
[[nodiscard]] inline bool starts_are_spread(const model::Deployment& deployment) {
  if (deployment.schedule || deployment.participants.empty()) return false;
  const auto& all = deployment.participants;
  const auto last = std::ranges::max_element(all, {}, &model::Participant::start);
  const auto done = std::ranges::min_element(all, {}, &model::Participant::endpoints_done);
  return last->start > done->endpoints_done;
}
/// Overrides that give it the usual ones, those of a user after them.
[[nodiscard]] inline std::vector<std::string> with_usual_hosts(std::vector<std::string> overrides) {
  overrides.insert(overrides.begin(), std::string{"hosts="} + usual_hosts);
  return overrides;
}

}  // namespace stormproof::trials
