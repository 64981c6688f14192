// Smaller deployments: two participants, parts of the given ones, fewer hosts, fewer endpoints.
#include "props/generators/edits.hpp"

namespace stormproof::props {

namespace {

using model::HostId;
using model::Participant;
using model::Scenario;

constexpr std::size_t most_pairs = 32;

/// Two participants of different hosts, as they are.
void add_pairs(const std::vector<Participant>& all, Edits& edits) {
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      if (all[i].host == all[j].host) continue;
      if (++pairs > most_pairs) return;
      edits.push_back([i, j](Scenario& s) {
        auto& participants = s.deployment.participants;
        participants = {participants[i], participants[j]};
      });
    }
  }
}

void add_removals(std::size_t size, Edits& edits) {
  for_parts(size, [&edits](std::size_t first, std::size_t last) {
    edits.push_back([first, last](Scenario& s) {
      auto& participants = s.deployment.participants;
      participants.erase(participants.begin() + static_cast<std::ptrdiff_t>(first),
                         participants.begin() + static_cast<std::ptrdiff_t>(last));
    });
  });
}

/// Fewer failures of one kind.
template <class Failure>
void add_life_edits(std::size_t size, std::vector<Failure> model::Life::*list, Edits& edits) {
  for_parts(size, [&](std::size_t first, std::size_t last) {
    edits.push_back([=](Scenario& s) {
      if (!s.deployment.life) return;
      auto& failures = (*s.deployment.life).*list;
      failures.erase(failures.begin() + static_cast<std::ptrdiff_t>(first),
                     failures.begin() + static_cast<std::ptrdiff_t>(last));
    });
  });
}

/// Hosts numbered from 0 in the order of their first participants.
void renumber_hosts(Scenario& scenario) {
  std::vector<HostId> known;
  for (Participant& p : scenario.deployment.participants) {
    const auto place = std::ranges::find(known, p.host);
    const auto number = static_cast<std::uint32_t>(place - known.begin());
    if (place == known.end()) known.push_back(p.host);
    p.host.value = number;
  }
}

void add_host_edits(const std::vector<Participant>& all, Edits& edits) {
  edits.push_back([](Scenario& s) {
    for (Participant& p : s.deployment.participants) p.host.value = 0;
    s.deployment.participants.back().host.value = 1;
  });
  edits.push_back(renumber_hosts);
  for (std::size_t k = 0; k < std::min(all.size(), most_edits / 2); ++k) {
    for (std::uint32_t host = 0; host < std::min(all[k].host.value, 2U); ++host) {
      edits.push_back([k, host](Scenario& s) { s.deployment.participants[k].host.value = host; });
    }
  }
}

/// `change` for the endpoints of all participants, of parts of them, and of one kind.
void add_endpoint_edits(std::size_t size, void (*change)(std::uint32_t&), Edits& edits) {
  for_parts(size, [&](std::size_t first, std::size_t last) {
    for (const auto kind : {0, 1, 2}) {
      edits.push_back([=](Scenario& s) {
        for (std::size_t k = first; k < last; ++k) {
          Participant& p = s.deployment.participants[k];
          if (kind != 1) change(p.publications);
          if (kind != 2) change(p.subscriptions);
        }
      });
    }
  });
}

}  // namespace

void add_deployment_edits(const Scenario& scenario, Edits& edits) {
  const auto& all = scenario.deployment.participants;
  if (const auto& life = scenario.deployment.life) {
    edits.push_back([](Scenario& s) { s.deployment.life.reset(); });
    add_life_edits(life->stale.size(), &model::Life::stale, edits);
    add_life_edits(life->mute.size(), &model::Life::mute, edits);
    add_life_edits(life->outages.size(), &model::Life::outages, edits);
    add_life_edits(life->restarts.size(), &model::Life::restarts, edits);
    add_life_edits(life->leases.size(), &model::Life::leases, edits);
    add_life_edits(life->endpoints.size(), &model::Life::endpoints, edits);
    if (life->lease) edits.push_back([](Scenario& s) { s.deployment.life->lease.reset(); });
  }
  add_pairs(all, edits);
  if (all.size() > 2) add_removals(all.size(), edits);
  add_host_edits(all, edits);
  add_endpoint_edits(
      all.size(), [](std::uint32_t& count) { count = 0; }, edits);
  add_endpoint_edits(
      all.size(), [](std::uint32_t& count) { count /= 2; }, edits);
  add_endpoint_edits(
      all.size(), [](std::uint32_t& count) { count -= std::min(count, 1U); }, edits);
}

}  // namespace stormproof::props
