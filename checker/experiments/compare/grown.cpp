// Works on the participants themselves, so it grows deployments of every form.
#include "checker/experiments/compare/grown.hpp"

#include <algorithm>
#include <map>

#include "model/nodes.hpp"

namespace stormproof::compare {

using model::Deployment;
using model::HostId;
using model::Participant;

namespace {

/// The participants of each host, hosts in the order of their numbers.
std::vector<std::vector<Participant>> by_host(const Deployment& deployment) {
  std::map<HostId, std::vector<Participant>> hosts;
  for (const Participant& one : deployment.participants) hosts[one.host].push_back(one);
  std::vector<std::vector<Participant>> lists;
  for (auto& [host, participants] : hosts) lists.push_back(std::move(participants));
  return lists;
}

std::uint32_t endpoints_of(const Participant& one) { return one.publications + one.subscriptions; }

/// `value` in proportion, rounded up.
std::uint32_t scaled(std::uint32_t value, std::uint64_t to, std::uint64_t of) {
  return static_cast<std::uint32_t>((value * to + of - 1) / of);
}

void grow_endpoints(Deployment& deployment, std::uint32_t size, std::uint32_t own) {
  for (Participant& one : deployment.participants) {
    const std::uint32_t before = endpoints_of(one);
    const std::uint32_t after = own == 0 ? size : scaled(before, size, own);
    const std::uint32_t publications =
        before == 0 ? (after + 1) / 2 : scaled(one.publications, after, before);
    one.publications = publications;
    one.subscriptions = after - publications;
  }
}

}  // namespace

const char* name_of(Grows what) {
  switch (what) {
    case Grows::robots:
      return "robots";
    case Grows::participants:
      return "participants";
    case Grows::endpoints:
      return "endpoints";
  }
  return "";
}

const char* words_of(Grows what) {
  switch (what) {
    case Grows::robots:
      return "robots";
    case Grows::participants:
      return "participants per robot";
    case Grows::endpoints:
      return "endpoints per participant";
  }
  return "";
}

std::uint32_t size_of(const Deployment& deployment, Grows what) {
  if (what == Grows::robots) return deployment.host_count();
  std::size_t most = 0;
  if (what == Grows::participants) {
    for (const auto& host : by_host(deployment)) most = std::max(most, host.size());
  } else {
    for (const Participant& one : deployment.participants) {
      most = std::max<std::size_t>(most, endpoints_of(one));
    }
  }
  return static_cast<std::uint32_t>(most);
}

Deployment grown(const Deployment& deployment, Grows what, std::uint32_t size) {
  const std::uint32_t own = size_of(deployment, what);
  if (size == own) return deployment;
  Deployment larger = deployment;
  if (what == Grows::endpoints) {
    grow_endpoints(larger, size, own);
    return larger;
  }
  const std::vector<std::vector<Participant>> hosts = by_host(deployment);
  const std::size_t host_count = what == Grows::robots ? size : hosts.size();
  larger.participants.clear();
  for (std::size_t h = 0; h < host_count; ++h) {
    const std::vector<Participant>& like = hosts[h % hosts.size()];
    const std::size_t count = what == Grows::robots
                                  ? like.size()
                                  : scaled(static_cast<std::uint32_t>(like.size()), size, own);
    for (std::size_t k = 0; k < count; ++k) {
      larger.participants.push_back(like[k % like.size()]);
      larger.participants.back().host = HostId{static_cast<std::uint32_t>(h)};
    }
  }
  return larger;
}

std::vector<std::uint32_t> usual_sizes(std::uint32_t own, std::uint32_t least) {
  constexpr std::size_t fewer = 2;
  constexpr std::size_t more = 3;
  std::vector<std::uint32_t> smaller;
  std::vector<std::uint32_t> larger;
  for (std::uint32_t unit = 1; larger.size() < more; unit *= 10) {
    for (const std::uint32_t step : {1U, 2U, 3U, 5U, 8U}) {
      const std::uint32_t size = step * unit;
      if (size > own && larger.size() < more) larger.push_back(size);
      if (size < own && size >= least) smaller.push_back(size);
    }
  }
  std::vector<std::uint32_t> sizes{own};
  const std::size_t kept = std::min(fewer, smaller.size());
  sizes.insert(sizes.begin(), smaller.end() - static_cast<std::ptrdiff_t>(kept), smaller.end());
  sizes.insert(sizes.end(), larger.begin(), larger.end());
  return sizes;
}

Deployment composed(const Deployment& deployment) {
  return model::sharing_participants(deployment, Deployment::max_participants);
}

Deployment beside_a_server(Deployment deployment) {
  for (Participant& one : deployment.participants) ++one.host.value;
  return deployment;
}

}  // namespace stormproof::compare
