// A grid of homogeneous deployments, some with drawn start times, and pairs and prefixes of the
// given one.
#include "checker/engines/exact/smaller_deployments.hpp"

#include <algorithm>

namespace stormproof::exact {

using model::Deployment;
using model::Nanoseconds;
using model::Participant;
using model::Scenario;

namespace {

struct Scale {
  std::uint32_t hosts = 0;
  std::uint32_t per_host = 0;   // largest number of participants on a host
  std::uint32_t endpoints = 0;  // largest number of user endpoints of a participant
};

Scale scale_of(const Deployment& deployment) {
  Scale scale;
  scale.hosts = deployment.host_count();
  for (const Participant& one : deployment.participants) {
    const auto on_host = std::ranges::count_if(
        deployment.participants, [&](const Participant& p) { return p.host == one.host; });
    scale.per_host = std::max(scale.per_host, static_cast<std::uint32_t>(on_host));
    scale.endpoints = std::max(scale.endpoints, one.publications + one.subscriptions);
  }
  return scale;
}

/// Everybody starts at 0, or as early as the schedule allows; creating endpoints takes as long as
/// for the given deployment's first participant.
void set_times(Deployment& deployment, const Deployment& given) {
  const Participant& first = given.participants.front();
  Nanoseconds start;
  Nanoseconds done = first.endpoints_done - first.start;
  if (given.schedule) {
    start = given.schedule->start_min;
    done = std::max(start, given.schedule->endpoints_done_min);
  }
  for (Participant& participant : deployment.participants) {
    participant.start = start;
    participant.endpoints_done = done;
  }
  deployment.loopback_delay = given.loopback_delay;
}

Scenario with(const Scenario& scenario, Deployment deployment) {
  Scenario smaller = scenario;
  smaller.deployment = std::move(deployment);
  smaller.deployment.hosts = scenario.deployment.hosts;
  smaller.deployment.access_points = scenario.deployment.access_points;
  smaller.deployment.wired_delay = scenario.deployment.wired_delay;
  smaller.deployment.schedule.reset();
  return smaller;
}

/// Only these participants, as they are.
Deployment part(const Deployment& given, const std::vector<std::size_t>& members) {
  Deployment deployment;
  deployment.loopback_delay = given.loopback_delay;
  for (const std::size_t member : members) {
    deployment.participants.push_back(given.participants[member]);
  }
  return deployment;
}

void add_grid(const Scenario& scenario, std::vector<Scenario>& list) {
  const Scale scale = scale_of(scenario.deployment);
  for (std::uint32_t per_host = 1; per_host <= std::min(scale.per_host, 3U); ++per_host) {
    for (std::uint32_t hosts = 2; hosts <= std::min(scale.hosts, 3U); ++hosts) {
      for (const std::uint32_t endpoints : {0U, 1U, 2U, 4U, 8U, 16U, 32U, 64U, 128U}) {
        if (endpoints > scale.endpoints) break;
        Deployment deployment = Deployment::homogeneous(hosts, per_host, endpoints);
        set_times(deployment, scenario.deployment);
        list.push_back(with(scenario, std::move(deployment)));
      }
    }
  }
}

/// Small deployments whose times are drawn from the given schedule: what needs two things to happen
/// a moment apart does not show if all start at once.
void add_drawn(const Scenario& scenario, std::vector<Scenario>& list) {
  constexpr std::uint64_t seeds = 8;
  if (!scenario.deployment.schedule) return;
  const Scale scale = scale_of(scenario.deployment);
  for (std::uint32_t per_host = 1; per_host <= std::min(scale.per_host, 3U); ++per_host) {
    for (const std::uint32_t endpoints : {0U, 8U}) {
      if (endpoints > scale.endpoints) break;
      for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        Deployment deployment = Deployment::homogeneous(2, per_host, endpoints);
        deployment.loopback_delay = scenario.deployment.loopback_delay;
        deployment.schedule = scenario.deployment.schedule;
        deployment.draw_schedule(seed);
        list.push_back(with(scenario, std::move(deployment)));
      }
    }
  }
}

void add_parts(const Scenario& scenario, std::vector<Scenario>& list) {
  constexpr std::size_t looked_at = 6;
  const auto& all = scenario.deployment.participants;
  const std::size_t count = std::min(looked_at, all.size());
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 1; j < count; ++j) {
      if (all[i].host == all[j].host) continue;
      list.push_back(with(scenario, part(scenario.deployment, {i, j})));
    }
  }
  std::vector<std::size_t> prefix;
  for (std::size_t i = 0; i + 1 < all.size() && i < looked_at; ++i) {
    prefix.push_back(i);
    Deployment deployment = part(scenario.deployment, prefix);
    if (i >= 2 && deployment.has_cross_host_pair()) {
      list.push_back(with(scenario, std::move(deployment)));
    }
  }
}

}  // namespace

std::vector<Scenario> smaller_scenarios(const Scenario& scenario) {
  std::vector<Scenario> list;
  add_grid(scenario, list);
  add_drawn(scenario, list);
  add_parts(scenario, list);
  return list;
}

}  // namespace stormproof::exact
