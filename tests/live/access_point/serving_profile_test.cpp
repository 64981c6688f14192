// Which profiles the access point takes, and what it says of the others.
#include "tests/live/access_point/serving_profile.hpp"

#include <gtest/gtest.h>

namespace stormproof::live {
namespace serving_profile_test {

std::string refusal(const std::string& profile, const std::vector<std::string>& overrides = {},
                    const std::string& overhead = {}) {
  const auto read = read_serving_profile(profile, overrides, overhead);
  return read ? "" : to_string(read.error());
}

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(AccessPointProfile, TakesTheEmulatedAccessPointAsItIs) {
  const auto read = read_serving_profile("emulated-ap", {}, "");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->overhead_unicast.count(), 150'000);
  EXPECT_TRUE(left_to_the_hosts(*read).empty());
}

TEST(AccessPointProfile, OverheadSetsBoth) {
  const auto read = read_serving_profile("emulated-ap", {"rate_multicast=12Mbps"}, "200us");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->overhead_unicast.count(), 200'000);
  EXPECT_EQ(read->overhead_multicast.count(), 200'000);
  EXPECT_EQ(read->rate_multicast.count(), 12'000'000);
}

TEST(AccessPointProfile, LeavesTheSendersOfThePaperToTheHosts) {
  const auto read = read_serving_profile("wifi-80211n-paper", {}, "");
  ASSERT_TRUE(read);
  const auto remarks = left_to_the_hosts(*read);
  ASSERT_EQ(remarks.size(), 2U);
  EXPECT_TRUE(mentions(remarks[0], "fragment_request"));
  EXPECT_TRUE(mentions(remarks[1], "source_queue_bytes"));
}

TEST(AccessPointProfile, TakesUnitsAndFlows) {
  const auto read = read_serving_profile("wifi-80211n-ampdu", {"queueing=flows"}, "");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->service, model::ServedBy::unit);
}

TEST(AccessPointProfile, RefusesWhatTwoTapDevicesCannotBe) {
  EXPECT_TRUE(mentions(refusal("ad-hoc"), "stages: expected two"));
  EXPECT_TRUE(mentions(refusal("cellular"), "stages: expected two on one channel"));
  EXPECT_TRUE(mentions(refusal("wired"), "kind: "));
  EXPECT_TRUE(mentions(refusal("emulated-ap", {"order=datagram_uplink"}), "order: "));
  EXPECT_TRUE(mentions(refusal("emulated-ap", {"lost_packets=[3]"}), "lost_packets: "));
  EXPECT_TRUE(mentions(refusal("emulated-ap", {"loss={probability: 0.1}"}), "loss: "));
}

TEST(AccessPointProfile, RefusesBadInputWithItsPlace) {
  EXPECT_TRUE(mentions(refusal("emulated-app"), "emulated-app"));
  EXPECT_TRUE(mentions(refusal("emulated-ap", {}, "150"), "--overhead: "));
  EXPECT_TRUE(mentions(refusal("emulated-ap", {"overheads=1us"}), "--set overheads=1us: "));
}

}  // namespace serving_profile_test
}  // namespace stormproof::live
