// Deployments that grow, and the ways to place what there is.
#include "checker/experiments/compare/grown.hpp"

#include <gtest/gtest.h>

namespace stormproof::compare {
namespace grown_test {

using model::Deployment;
using model::HostId;
using model::Nanoseconds;

TEST(Grown, IsWhatTheShortFormSays) {
  const Deployment own = Deployment::homogeneous(2, 3, 20);
  for (const Grows what : {Grows::robots, Grows::participants, Grows::endpoints}) {
    EXPECT_EQ(grown(own, what, size_of(own, what)), own) << name_of(what);
  }
  EXPECT_EQ(grown(own, Grows::robots, 5), Deployment::homogeneous(5, 3, 20));
  EXPECT_EQ(grown(own, Grows::participants, 8), Deployment::homogeneous(2, 8, 20));
  EXPECT_EQ(grown(own, Grows::endpoints, 30), Deployment::homogeneous(2, 3, 30));
  EXPECT_EQ(grown(own, Grows::participants, 1), Deployment::homogeneous(2, 1, 20));
}

TEST(Grown, FurtherHostsAndParticipantsAreLikeThoseThatThereAre) {
  Deployment own;
  own.participants = {
      {HostId{0}, 1, 0, {}, {}}, {HostId{4}, 2, 2, {}, {}}, {HostId{4}, 0, 4, {}, {}}};
  EXPECT_EQ(size_of(own, Grows::robots), 2U);
  EXPECT_EQ(size_of(own, Grows::participants), 2U);
  EXPECT_EQ(size_of(own, Grows::endpoints), 4U);
  const Deployment three = grown(own, Grows::robots, 3);
  ASSERT_EQ(three.size(), 4U);
  EXPECT_EQ(three.participants[3].publications, 1U);
  EXPECT_EQ(three.participants[3].host, HostId{2});
  const Deployment more = grown(own, Grows::participants, 4);
  EXPECT_EQ(more.size(), 2U + 4U);
  const Deployment larger = grown(own, Grows::endpoints, 8);
  EXPECT_EQ(larger.participants[0].publications, 2U);
  EXPECT_EQ(larger.participants[1].subscriptions, 4U);
  EXPECT_EQ(larger.participants[2].publications, 0U);
}

TEST(Grown, TheUsualSizesAreAroundTheOwn) {
  EXPECT_EQ(usual_sizes(2, 2), (std::vector<std::uint32_t>{2, 3, 5, 8}));
  EXPECT_EQ(usual_sizes(5, 1), (std::vector<std::uint32_t>{2, 3, 5, 8, 10, 20}));
  EXPECT_EQ(usual_sizes(25, 1), (std::vector<std::uint32_t>{10, 20, 25, 30, 50, 80}));
  EXPECT_EQ(usual_sizes(0, 1), (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

TEST(Composed, AHostBecomesOneParticipantAsNodesPerParticipantMakesIt) {
  EXPECT_EQ(composed(Deployment::homogeneous(3, 5, 20)), Deployment::homogeneous(3, 5, 20, 5));
  Deployment own = Deployment::homogeneous(2, 2, 4);
  own.participants[0].start = Nanoseconds{7};
  own.participants[1].start = Nanoseconds{3};
  own.participants[1].endpoints_done = Nanoseconds{9};
  const Deployment together = composed(own);
  EXPECT_EQ(together.participants[0].start, Nanoseconds{3});
  EXPECT_EQ(together.participants[0].endpoints_done, Nanoseconds{9});
}

TEST(BesideAServer, NobodyIsOnItsHost) {
  for (const auto& one : beside_a_server(Deployment::homogeneous(2, 2, 4)).participants) {
    EXPECT_NE(one.host, HostId{0});
  }
}

}  // namespace grown_test
}  // namespace stormproof::compare
