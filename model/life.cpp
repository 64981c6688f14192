// Looks through the lists of a life; they are short.
#include "model/life.hpp"

#include <algorithm>

#include "model/implementations.hpp"
#include "model/servers.hpp"

namespace stormproof::model {

bool is_away(const Life& life, std::uint32_t participant, Nanoseconds time) {
  const auto is_silent = [&](const Mute& mute) {
    return mute.participant == participant && time >= mute.from;
  };
  const auto has_stopped = [&](const Restart& restart) {
    return restart.participant == participant && time >= restart.stop &&
           restart.goodbye == Goodbye::no &&
           (time < restart.start || restart.identity == Identity::fresh);
  };
  return std::ranges::any_of(life.mute, is_silent) ||
         std::ranges::any_of(life.restarts, has_stopped);
}

bool is_replaced(const Life& life, std::uint32_t participant) {
  return std::ranges::any_of(life.restarts, [&](const Restart& restart) {
    return restart.participant == participant && restart.identity == Identity::fresh;
  });
}

std::vector<bool> those_who_die(const Scenario& scenario) {
  std::vector<bool> dying(scenario.deployment.size() + server_count(scenario.deployment));
  if (!scenario.deployment.life || !traits_of(scenario.dds).has_living_composition) return dying;
  const Life& life = *scenario.deployment.life;
  for (const Mute& mute : life.mute) dying[mute.participant] = true;
  for (const Leave& leave : life.leaves) dying[leave.participant] = true;
  for (const Restart& restart : life.restarts) {
    if (restart.identity == Identity::fresh) dying[restart.participant] = true;
  }
  return dying;
}

HostId host_of(const Deployment& deployment, std::uint32_t participant) {
  const auto& all = deployment.participants;
  if (participant < all.size()) return all[participant].host;
  return host_of_server(deployment, participant - deployment.size());
}

bool checks_lease(const Scenario& scenario, std::uint32_t i, std::uint32_t j) {
  const std::uint32_t first_server = scenario.deployment.size();
  return !traits_of(scenario.dds).has_server || i >= first_server || j >= first_server;
}

bool hears(const Deployment& deployment, std::uint32_t i, std::uint32_t j, Nanoseconds emitted,
           Nanoseconds now) {
  if (!deployment.life) return true;
  const Life& life = *deployment.life;
  if (is_away(life, i, emitted) || is_away(life, j, now)) return false;
  if (j < deployment.size()) {
    const Participant& receiver = deployment.participants[j];
    if (now < receiver.ready.value_or(receiver.start)) return false;
  }
  const auto host = [&](std::uint32_t k) { return host_of(deployment, k).value; };
  if (host(i) == host(j)) return true;
  const auto is_one = [&](Reach reach, std::uint32_t number, std::uint32_t k) {
    return reach == Reach::all || number == (reach == Reach::host ? host(k) : k);
  };
  return std::ranges::none_of(life.outages, [&](const Outage& outage) {
    return is_one(outage.from_reach, outage.from, i) && is_one(outage.to_reach, outage.to, j) &&
           now >= outage.start && now < outage.end;
  });
}

std::optional<Nanoseconds> lease_of(const Life& life, std::uint32_t participant) {
  const auto own = std::ranges::find(life.leases, participant, &Lease::participant);
  return own == life.leases.end() ? life.lease : own->duration;
}

bool forgets(const Life& life) {
  return life.lease || !life.leases.empty() || !life.restarts.empty();
}

std::uint32_t late_descriptors(const Life& life, std::uint32_t participant, Stream s) {
  std::uint32_t count = 0;
  for (const LateEndpoints& late : life.endpoints) {
    if (late.participant != participant) continue;
    count += (s == Stream::pub ? late.publications : late.subscriptions) * (late.until ? 2 : 1);
  }
  return count;
}

Nanoseconds last_start(const Deployment& deployment) {
  Nanoseconds last;
  for (const Participant& participant : deployment.participants) {
    last = std::max(last, participant.start);
  }
  if (!deployment.life) return last;
  for (const Restart& restart : deployment.life->restarts) last = std::max(last, restart.start);
  for (const LateEndpoints& late : deployment.life->endpoints) {
    last = std::max(last, late.until.value_or(late.at));
  }
  for (const Deletion& deletion : deployment.life->deletions) last = std::max(last, deletion.at);
  return last;
}

Nanoseconds last_failure(const Deployment& deployment) {
  Nanoseconds last = last_start(deployment);
  if (!deployment.life) return last;
  for (const Outage& outage : deployment.life->outages) last = std::max(last, outage.end);
  for (const Mute& mute : deployment.life->mute) last = std::max(last, mute.from);
  for (const Leave& leave : deployment.life->leaves) last = std::max(last, leave.at);
  return last;
}

Nanoseconds settled_at(const Deployment& deployment) {
  if (!deployment.life || !forgets(*deployment.life)) return {};
  const Life& life = *deployment.life;
  Nanoseconds longest = life.lease.value_or(Nanoseconds{});
  for (const Lease& lease : life.leases) longest = std::max(longest, lease.duration);
  return last_failure(deployment) + longest;
}

bool comes_back_in_order(const Deployment& deployment) {
  if (!deployment.life) return true;
  std::vector<Restart> restarts = deployment.life->restarts;
  std::ranges::sort(restarts, {}, [](const Restart& r) {
    return std::pair{r.participant, r.stop};
  });
  for (std::size_t k = 0; k < restarts.size(); ++k) {
    const Restart& restart = restarts[k];
    const bool is_first = k == 0 || restarts[k - 1].participant != restart.participant;
    const bool is_listed = restart.participant < deployment.size();
    if (is_first && is_listed &&
        restart.stop < deployment.participants[restart.participant].start) {
      return false;
    }
    if (is_first) continue;
    const Restart& before = restarts[k - 1];
    if (before.identity == Identity::fresh || restart.stop < before.start) return false;
  }
  return true;
}

bool creates_while_there(const Deployment& deployment) {
  if (!deployment.life) return true;
  const auto is_there = [&](std::uint32_t participant, Nanoseconds time) {
    return time >= deployment.participants[participant].start &&
           !is_away(*deployment.life, participant, time);
  };
  return std::ranges::all_of(deployment.life->endpoints, [&](const LateEndpoints& late) {
    return late.participant < deployment.size() && is_there(late.participant, late.at) &&
           (!late.until || is_there(late.participant, *late.until));
  });
}

bool has_successors(const Deployment& deployment) {
  return deployment.life &&
         std::ranges::find(deployment.life->restarts, Identity::fresh, &Restart::identity) !=
             deployment.life->restarts.end();
}

Scenario as_run(const Scenario& scenario) {
  Scenario all = scenario;
  all.deployment = with_successors(scenario.deployment);
  const ImplementationTraits& traits = traits_of(scenario.dds);
  std::optional<Life>& life = all.deployment.life;
  if (announces_to_ports(scenario) && !life) {
    life.emplace();
    choose_lease(all);
  }
  const bool acts = traits.has_event_thread || (traits.has_living_composition && life != Life{});
  if (life && acts && !life->lease) life->lease = lease_of(scenario.dds);
  return all;
}

namespace {

std::uint32_t successors_of(const Deployment& deployment) {
  return static_cast<std::uint32_t>(
      std::ranges::count(deployment.life->restarts, Identity::fresh, &Restart::identity));
}

/// Discovery Servers are those after all others.
void renumber_servers(Life& life, std::uint32_t first, std::uint32_t further) {
  const auto renumber = [&](std::uint32_t& participant) {
    if (participant >= first) participant += further;
  };
  for (Mute& mute : life.mute) renumber(mute.participant);
  for (Lease& lease : life.leases) renumber(lease.participant);
  for (Restart& restart : life.restarts) renumber(restart.participant);
  for (Outage& outage : life.outages) {
    if (outage.from_reach == Reach::participant) renumber(outage.from);
    if (outage.to_reach == Reach::participant) renumber(outage.to);
  }
}

}  // namespace

Deployment with_successors(const Deployment& deployment) {
  Deployment all = deployment;
  if (!has_successors(deployment)) return all;
  renumber_servers(*all.life, deployment.size(), successors_of(deployment));
  for (const Restart& restart : deployment.life->restarts) {
    if (restart.identity != Identity::fresh) continue;
    Participant successor = deployment.participants[restart.participant];
    successor.endpoints_done = restart.start + (successor.endpoints_done - successor.start);
    const Nanoseconds later = restart.start - successor.start;
    if (successor.open) *successor.open += later;
    if (successor.ready) *successor.ready += later;
    successor.start = restart.start;
    all.participants.push_back(successor);
    for (const Lease& lease : deployment.life->leases) {
      if (lease.participant != restart.participant) continue;
      all.life->leases.push_back({all.size() - 1, lease.duration});
    }
  }
  return all;
}

}  // namespace stormproof::model
