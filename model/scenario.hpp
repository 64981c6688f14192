// A scenario: one deployment, one DDS profile, one wireless profile, one time limit. It determines
// one trajectory, to the nanosecond. `model/config/scenario_file.hpp` reads it from YAML.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "model/dds_profile.hpp"
#include "model/deployment.hpp"
#include "model/host.hpp"
#include "model/limits.hpp"
#include "model/units.hpp"
#include "model/wireless_profile.hpp"

namespace stormproof::model {

/// What ends a run: the completion of discovery, in the middle of the packet that completes it; the
/// time limit alone, so that what follows discovery is part of the run; or, before that limit, that
/// nothing is left to do but announcements, and nothing fails any more.
enum class RunUntil : std::uint8_t { completion, time_limit, quiescence };

struct Scenario {
  Deployment deployment;
  DdsProfile dds;
  WirelessProfile wireless;
  std::optional<Processor> hosts = {};      ///< of every host; absent: programs take no time
  Nanoseconds time_limit{200'000'000'000};  ///< events up to and including this time are processed
  RunUntil run_until = RunUntil::completion;
  std::optional<Limits> limits;   ///< what the author demands; they change no run
  std::optional<Variation> vary;  ///< ranges for `stormproof fuzz`; they change no run

  bool operator==(const Scenario&) const = default;
};

/// The profile that the participant has: its own, or the scenario's.
[[nodiscard]] inline const DdsProfile& dds_of(const Scenario& scenario, std::uint32_t participant) {
  if (participant >= scenario.deployment.size()) return scenario.dds;  // a Discovery Server
  const Shared<DdsProfile>& own = scenario.deployment.participants[participant].dds;
  return own ? *own : scenario.dds;
}
/// Whether some participant has another profile than the scenario says for all.
[[nodiscard]] inline bool is_mixed(const Scenario& scenario) {
  return std::ranges::any_of(scenario.deployment.participants, [&](const Participant& one) {
    return one.dds && *one.dds != scenario.dds;
  });
}
/// Whether it holds for the profile of some participant.
template <class Holds>
[[nodiscard]] bool some_profile(const Scenario& scenario, Holds&& holds) {
  return std::ranges::any_of(scenario.deployment.participants, [&](const Participant& one) {
    return holds(one.dds ? *one.dds : scenario.dds);
  });
}

/// Whether somebody announces itself to ports of hosts, beside the group (Cyclone DDS's peers).
[[nodiscard]] inline bool announces_to_ports(const Scenario& scenario) {
  return some_profile(scenario, [](const DdsProfile& dds) { return dds.peers > 0; });
}

/// Says what the network is good for where a DDS profile leaves that open: Cyclone DDS sends
/// everything by multicast where it is not flaky, which it takes Wi-Fi for (q_init.c, mc_flaky in
/// ddsi_ownip.c). A channel that hosts share counts as Wi-Fi.
inline void choose_multicast(Scenario& scenario) {
  const bool is_wired = scenario.wireless.kind == ServiceKind::constant_delay;
  const AllowMulticast choice = is_wired ? AllowMulticast::always : AllowMulticast::spdp;
  const auto is_open = [](const DdsProfile& dds) {
    return dds.allow_multicast == AllowMulticast::by_network;
  };
  if (is_open(scenario.dds)) scenario.dds.allow_multicast = choice;
  for (Participant& one : scenario.deployment.participants) {
    if (one.dds && is_open(*one.dds)) one.dds.emplace(*one.dds).allow_multicast = choice;
  }
}

/// The leases of profiles are those of a life which says none.
inline void choose_lease(Scenario& scenario) {
  std::optional<Life>& life = scenario.deployment.life;
  if (!life || life->lease) return;
  life->lease = scenario.dds.spdp.lease;
  for (std::uint32_t i = 0; i < scenario.deployment.size(); ++i) {
    const std::optional<Nanoseconds> own = dds_of(scenario, i).spdp.lease;
    const bool is_said = std::ranges::count(life->leases, i, &Lease::participant) > 0;
    if (own && own != life->lease && !is_said) life->leases.push_back({i, *own});
  }
}

/// Whether a seed changes the scenario: start times are drawn, how long participants are deaf, or
/// transmissions that fail.
[[nodiscard]] inline bool is_drawn(const Scenario& scenario) {
  const bool is_deaf = scenario.hosts && scenario.hosts->deaf_min < scenario.hosts->deaf_max;
  return scenario.deployment.schedule || scenario.wireless.loss || is_deaf;
}
/// The seed of the scenario as it is; 0 if nothing is drawn.
[[nodiscard]] inline std::uint64_t own_seed(const Scenario& scenario) {
  if (scenario.deployment.schedule) return scenario.deployment.schedule->seed;
  if (scenario.wireless.loss) return scenario.wireless.loss->seed;
  return scenario.hosts ? scenario.hosts->deaf_seed : 0;
}
/// Draws what is drawn from this seed.
inline void draw(Scenario& scenario, std::uint64_t seed) {
  if (scenario.deployment.schedule) scenario.deployment.draw_schedule(seed);
  if (scenario.wireless.loss) scenario.wireless.loss->seed = seed;
  if (scenario.hosts) scenario.hosts->deaf_seed = seed;
}

}  // namespace stormproof::model
