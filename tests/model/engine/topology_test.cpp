// The numbering of pairs and relations against its definition, with hosts of different sizes.
#include "model/engine/topology.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace stormproof::model {
namespace topology_test {

Deployment on_hosts(const std::vector<std::uint32_t>& hosts) {
  Deployment deployment;
  for (std::uint32_t i = 0; i < hosts.size(); ++i) {
    Participant participant;
    participant.host = HostId{hosts[i]};
    participant.publications = i;
    participant.subscriptions = 2 * i;
    participant.start = Nanoseconds{10 * i};
    deployment.participants.push_back(participant);
  }
  return deployment;
}

RC_GTEST_PROP(Topology, NumbersExactlyTheCrossHostPairsInOrder, ()) {
  const auto hosts =
      *rc::gen::container<std::vector<std::uint32_t>>(rc::gen::inRange<std::uint32_t>(0, 4));
  const Topology topology{on_hosts(hosts), DescriptorProfile{}};
  const auto n = static_cast<std::uint32_t>(hosts.size());
  RC_ASSERT(topology.participant_count() == n);
  std::uint32_t number = 0;
  std::uint64_t deliveries = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    RC_ASSERT(topology.first_pair(i) == number);
    for (std::uint32_t j = 0; j < n; ++j) {
      if (hosts[i] == hosts[j]) continue;
      const Pair& pair = topology.pair(number);
      RC_ASSERT(pair.source == i);
      RC_ASSERT(pair.destination == j);
      const Pair& back = topology.pair(pair.reverse);
      RC_ASSERT(back.source == j);
      RC_ASSERT(back.destination == i);
      RC_ASSERT(back.reverse == number);
      RC_ASSERT(topology.descriptor_count(2 * number) == 9 + i);
      RC_ASSERT(topology.descriptor_count(2 * number + 1) == 8 + 2 * i);
      deliveries += 17 + 3 * i;
      ++number;
    }
    RC_ASSERT(topology.peer_count(i) == number - topology.first_pair(i));
  }
  RC_ASSERT(topology.pair_count() == number);
  RC_ASSERT(topology.relation_count() == 2 * number);
  RC_ASSERT(topology.required_deliveries() == deliveries);
}

TEST(Topology, UnevenHosts) {
  const Topology topology{on_hosts({0, 1, 1, 0, 2}), DescriptorProfile{}};
  EXPECT_EQ(topology.pair_count(), 16U);
  EXPECT_EQ(topology.peer_count(0), 3U);
  EXPECT_EQ(topology.peer_count(4), 4U);
  EXPECT_EQ(topology.start(3), Nanoseconds{30});
  EXPECT_EQ(topology.descriptor_count(3, Stream::pub), 12U);
  EXPECT_EQ(topology.descriptor_count(3, Stream::sub), 14U);
}

TEST(Topology, TheHomogeneousWorkloadIsThePapersFormula) {
  const Topology topology{Deployment::homogeneous(3, 4, 7), DescriptorProfile{}};
  EXPECT_EQ(topology.required_deliveries(), 3U * 2U * 4U * 4U * (17U + 7U));
  EXPECT_EQ(topology.relation_count(), 2U * 3U * 2U * 4U * 4U);
}

TEST(Topology, OneHostHasNoPairs) {
  const Topology topology{on_hosts({5, 5, 5}), DescriptorProfile{}};
  EXPECT_EQ(topology.pair_count(), 0U);
  EXPECT_EQ(topology.required_deliveries(), 0U);
  EXPECT_EQ(topology.peer_count(1), 0U);
}

}  // namespace topology_test
}  // namespace stormproof::model
