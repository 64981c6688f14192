// Who is on which host, and how many access points there are, if no host is listed.
#include "model/engine/fleet.hpp"

#include <gtest/gtest.h>

namespace stormproof::model {
namespace fleet_test {

TEST(Fleet, ADiscoveryServerIsOnHost0) {
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(2, 2, 0);
  const Fleet fleet{scenario};
  EXPECT_EQ(fleet.host_of(3), 1U);
  EXPECT_EQ(fleet.host_of(4), 0U);
  EXPECT_FALSE(fleet.is_listed());
  EXPECT_EQ(fleet.access_point_count(), 1U);
}

}  // namespace fleet_test
}  // namespace stormproof::model
