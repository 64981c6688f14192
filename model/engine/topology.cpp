// Numbers the cross-host pairs of a deployment.
#include "model/engine/topology.hpp"

#include <algorithm>

#include "model/implementations.hpp"
#include "model/life.hpp"
#include "model/servers.hpp"

namespace stormproof::model {

SameHostPairs same_host_pairs(const DdsProfile& dds) {
  if (traits_of(dds).has_server) return SameHostPairs::with_server;
  return traits_of(dds).discovers_same_host ? SameHostPairs::included : SameHostPairs::left_out;
}

Topology topology_of(const Scenario& scenario) {
  return {scenario.deployment, scenario.dds.descriptors, same_host_pairs(scenario.dds)};
}

Topology::Topology(const Deployment& deployment, const DescriptorProfile& descriptors,
                   SameHostPairs same_host)
    : first_server_{deployment.size()},
      participant_count_{first_server_ + (same_host == SameHostPairs::with_server
                                              ? model::server_count(deployment)
                                              : 0U)} {
  const auto& participants = deployment.participants;
  const auto host = [&](std::uint32_t i) { return host_of(deployment, i); };
  first_pair_.assign(participant_count_ + 1, 0);
  for (std::uint32_t i = 0; i < participant_count_; ++i) {
    first_pair_[i] = pair_count();
    for (std::uint32_t j = 0; j < participant_count_; ++j) {
      const bool cross_host = host(i) != host(j);
      if (cross_host || (i != j && same_host != SameHostPairs::left_out)) {
        pairs_.push_back({i, j, 0, cross_host});
      }
    }
    if (is_server(i)) {
      descriptor_count_.insert(descriptor_count_.end(), {0, 0});
      start_.push_back({});
      late_publications_.push_back(0);
      continue;
    }
    // Those that create endpoints over time have late ones besides.
    const bool all_at_once = same_host == SameHostPairs::left_out;
    const auto late = [&](Stream s) {
      return deployment.life && all_at_once ? late_descriptors(*deployment.life, i, s) : 0;
    };
    late_publications_.push_back(0);
    for (const LateEndpoints& one : deployment.life.value_or(Life{}).endpoints) {
      if (one.participant == i && !all_at_once) late_publications_.back() += one.publications;
    }
    descriptor_count_.push_back(descriptors.default_publications + participants[i].publications +
                                late(Stream::pub));
    descriptor_count_.push_back(descriptors.default_subscriptions + participants[i].subscriptions +
                                late(Stream::sub));
    start_.push_back(participants[i].start);
  }
  first_pair_[participant_count_] = pair_count();

  // Pairs (j, i) come in ascending j for each i, which is the order of i's own pairs (i, j).
  std::vector<std::uint32_t> next = first_pair_;
  for (std::uint32_t number = 0; number < pair_count(); ++number) {
    pairs_[number].reverse = next[pairs_[number].destination]++;
    if (same_host == SameHostPairs::with_server) {
      required_deliveries_ +=
          matching_descriptors(pairs_[number].source, pairs_[number].destination, descriptors);
      continue;
    }
    if (!pairs_[number].cross_host) continue;
    required_deliveries_ += descriptor_count(2 * number) + descriptor_count(2 * number + 1);
  }
}

std::uint32_t Topology::matching_descriptors(std::uint32_t i, std::uint32_t j,
                                             const DescriptorProfile& defaults) const {
  if (is_server(i) || is_server(j)) return 0;
  const auto user = [&](std::uint32_t k, Stream s) {
    return descriptor_count(k, s) -
           (s == Stream::pub ? defaults.default_publications : defaults.default_subscriptions);
  };
  constexpr std::uint32_t shared_by_all = 4;  // ros_discovery_info and parameter_events, both sides
  return shared_by_all + std::min(user(i, Stream::pub), user(j, Stream::sub)) +
         std::min(user(i, Stream::sub), user(j, Stream::pub));
}

std::uint32_t Topology::pair_between(std::uint32_t i, std::uint32_t j) const {
  const auto begin = pairs_.begin() + first_pair_[i];
  const auto end = pairs_.begin() + first_pair_[i + 1];
  // Where it is if i has a pair with everybody.
  const auto expected = begin + (j > i ? j - 1 : j);
  if (expected < end && expected->destination == j) {
    return static_cast<std::uint32_t>(expected - pairs_.begin());
  }
  const auto found = std::lower_bound(begin, end, j, [](const Pair& pair, std::uint32_t value) {
    return pair.destination < value;
  });
  return static_cast<std::uint32_t>(found - pairs_.begin());
}

}  // namespace stormproof::model
