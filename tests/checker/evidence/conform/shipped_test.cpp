// Real captures conform to the profile of the version that they show, and are told apart from those
// of other versions: by the interval of initial ACKNACKs, by resends, and by delays.
#include <set>

#include <gtest/gtest.h>

#include "tests/checker/evidence/conform/captures.hpp"

namespace stormproof::conform::testing {
namespace shipped_test {

struct Shipped {
  std::string name;
  std::string profile;
  bool is_lossless = true;  ///< the link lost nothing
};

std::ostream& operator<<(std::ostream& out, const Shipped& one) { return out << one.name; }

const std::vector<Shipped>& fastdds_captures() {
  static const std::vector<Shipped> list{
      {"fastdds2611_ap150_np1_ne2_r0", "fastdds-2.6.11"},
      {"fastdds2611_ap150_np2_ne20_r0", "fastdds-2.6.11"},
      {"fastdds2611_ap150_np2_ne30_r0", "fastdds-2.6.11"},
      {"fastdds2611_ap150_np3_ne30_r0", "fastdds-2.6.11"},
      {"fastdds2611_ap150_np4_ne30_r1", "fastdds-2.6.11"},
      {"fastdds2611_ap150_np5_ne2_r0", "fastdds-2.6.11"},
      {"fastdds2611_ap150_np6_ne30_r0", "fastdds-2.6.11"},
      {"fastdds2611_ap150_loss5_np3_ne20_r0", "fastdds-2.6.11", false},
      {"fastdds2611_veth_np3_ne10_r0", "fastdds-2.6.11"},
      {"fastdds2611like_ap_np1_ne30_r0", "fastdds-2.6.11"},
      {"fastdds2611like_pre_ap_np3_ne20_r0", "fastdds-2.6.11"},
      // A queue of 200 frames overflows; and the sockets' receive buffers.
      {"fastdds2611like_O250_q200_ap_np4_ne10_r0", "fastdds-2.6.11", false},
      {"fastdds2611like_pre_veth_np5_ne20_r0", "fastdds-2.6.11", false},
      {"fastdds291_ap_np1_ne2_r0", "fastdds-2.9.1"},
      {"fastdds291_ap_np3_ne10_r0", "fastdds-2.9.1"},
      {"fastdds291_veth_np1_ne2_r0", "fastdds-2.9.1"},
      {"fastdds291_veth_np2_ne20_r0", "fastdds-2.9.1"},
      // Its sockets' receive buffers overflow.
      {"fastdds291_veth_np5_ne20_r0", "fastdds-2.9.1", false}};
  return list;
}

class ShippedCapture : public ::testing::TestWithParam<Shipped> {};

TEST_P(ShippedCapture, ConformsToItsVersion) {
  const Conformance result = conformance(shipped(GetParam().name), profile(GetParam().profile));
  EXPECT_TRUE(is_explained(result)) << description(result);
  EXPECT_GT(result.checked, 50U);
  EXPECT_EQ(result.lost == 0, GetParam().is_lossless) << result.lost;
}

/// Version 2.14.5 answers new participants alone and replies later.
TEST_P(ShippedCapture, DoesNotConformToCorrectedDelays) {
  const Conformance result = conformance(shipped(GetParam().name), profile("fastdds-2.14.5"));
  ASSERT_EQ(result.verdict, Verdict::does_not_conform);
  EXPECT_EQ(result.unexplained.front().fault, Fault::announcement_extra) << description(result);
  std::set<Fault> faults;
  for (const Unexplained& one : result.unexplained) faults.insert(one.fault);
  EXPECT_TRUE(faults.contains(Fault::acknack_early)) << description(result);
}

INSTANTIATE_TEST_SUITE_P(Shipped, ShippedCapture, ::testing::ValuesIn(fastdds_captures()),
                         [](const auto& one) { return one.param.name; });

/// The capture shows initial ACKNACKs that come again after the same time: with 2.6.11 the second
/// would come after twice that.
TEST(TellingVersionsApart, AConstantIntervalIsTooEarlyForADoublingOne) {
  const Conformance result =
      conformance(shipped("fastdds291_ap_np3_ne10_r0"), profile("fastdds-2.6.11"));
  ASSERT_EQ(result.verdict, Verdict::does_not_conform);
  for (const Unexplained& one : result.unexplained) {
    EXPECT_EQ(one.fault, Fault::initial_early) << description(result);
    ASSERT_EQ(one.needs.size(), 2U);
    EXPECT_EQ(one.needs.back().bound_ns, 140'000'000);
    EXPECT_LT(one.needs.back().needed_ns, 140'000'000);
  }
}

/// The third initial ACKNACK comes 140 ms after the second: too late for a constant 70 ms.
TEST(TellingVersionsApart, ADoublingIntervalIsTooLateForAConstantOne) {
  const Conformance result =
      conformance(shipped("fastdds2611_ap150_np4_ne30_r1"), profile("fastdds-2.9.1"));
  ASSERT_EQ(result.verdict, Verdict::does_not_conform);
  for (const Unexplained& one : result.unexplained) {
    EXPECT_EQ(one.fault, Fault::initial_late) << description(result);
    ASSERT_FALSE(one.needs.empty());
    EXPECT_EQ(one.needs.front().what, "lateness");
    EXPECT_GT(one.needs.front().needed_ns, one.needs.front().bound_ns);
  }
}

/// What the need of a finding says is enough, and less is not.
TEST(TellingVersionsApart, MoreLatenessWouldExplainTheOtherVersion) {
  const auto conversation = shipped("fastdds2611_ap150_np4_ne30_r1");
  const model::DdsProfile other = profile("fastdds-2.9.1");
  Bounds bounds;
  const Conformance result = conformance(conversation, other, bounds);
  std::int64_t needed = 0;
  for (const Unexplained& one : result.unexplained) {
    needed = std::max(needed, one.needs.front().needed_ns.value_or(0));
  }
  bounds.most_lateness_ns = needed;
  EXPECT_EQ(conformance(conversation, other, bounds).verdict, Verdict::conforms);
  bounds.most_lateness_ns = needed - 1;
  EXPECT_EQ(conformance(conversation, other, bounds).verdict, Verdict::does_not_conform);
}

/// Cyclone DDS opens with DATA, and announces to one participant at a time.
TEST(TellingVersionsApart, CycloneConformsToNoFastDds) {
  for (const char* name : {"cyclone0102_veth_np2_ne20_r0", "cyclone0102uni_veth_np2_ne20_r0",
                           "cyclone0102uni_ap_np5_ne20_r0"}) {
    const auto conversation = shipped(name);
    for (const char* version :
         {"fastdds-2.6.11", "fastdds-2.9.1", "fastdds-2.14.5", "fastdds-3.6"}) {
      const Conformance result = conformance(conversation, profile(version));
      ASSERT_EQ(result.verdict, Verdict::does_not_conform) << name << " " << version;
      std::set<Fault> faults;
      for (const Unexplained& one : result.unexplained) faults.insert(one.fault);
      EXPECT_TRUE(faults.contains(Fault::not_opened)) << name << " " << version;
    }
  }
}

}  // namespace shipped_test
}  // namespace stormproof::conform::testing
