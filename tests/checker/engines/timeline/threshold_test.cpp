// The threshold: eliminated, proved, exact, and applied to profiles.
#include <gtest/gtest.h>

#include "checker/engines/timeline/free_threshold.hpp"
#include "tests/checker/engines/timeline/requests.hpp"

namespace stormproof::timeline {
namespace threshold_test {

using model::Nanoseconds;

std::pair<std::vector<EliminatedCondition>, props::Finding> proved(const ThresholdShift& shift) {
  std::vector<EliminatedCondition> parts;
  props::Finding finding =
      finding_of([&](Theorem& t) { parts = prove_free_threshold(t, shift); }, {});
  return {std::move(parts), std::move(finding)};
}

TEST(FreeThreshold, IsEliminatedAndProved) {
  const auto [parts, finding] = proved({});
  EXPECT_EQ(finding.kind, props::VerdictKind::proved) << finding.how;
  ASSERT_EQ(parts.size(), 6U);
  for (const EliminatedCondition& part : parts) {
    EXPECT_EQ(part.eliminated.find("_delay"), std::string::npos) << part.eliminated;
    EXPECT_FALSE(part.eliminated.empty());
  }
  EXPECT_EQ(parts[2].eliminated, "false");  // nothing is asked for that is not overtaken
}

TEST(FreeThreshold, IsExactToTheNanosecond) {
  for (const int nanoseconds : {1, -1}) {
    const auto [parts, finding] = proved({nanoseconds});
    EXPECT_EQ(finding.kind, props::VerdictKind::inconclusive);
    EXPECT_NE(finding.how.find("refuted"), std::string::npos) << finding.how;
  }
}

TEST(FreeThreshold, OfProfiles) {
  model::SedpProfile sedp;
  EXPECT_EQ(free_threshold(sedp, false).delta, Nanoseconds{10'000});
  EXPECT_EQ(free_threshold(sedp, true).delta, Nanoseconds{70'090'000});
  sedp.relation_opening = model::RelationOpening::each_side;
  EXPECT_FALSE(free_threshold(sedp, true).exists);
  sedp.unmatched = model::Unmatched::accept;  // an initial ACKNACK can meet the opening
  EXPECT_FALSE(free_threshold(sedp, true).exists);
  sedp.relation_opening = model::RelationOpening::receiver;
  sedp.initial_acknack_delay = Nanoseconds{5'000};
  EXPECT_EQ(free_threshold(sedp, false).delta, Nanoseconds{5'000});
  sedp.initial_acknack = model::InitialAckNackReply::heartbeat;
  EXPECT_EQ(free_threshold(sedp, false).delta, Nanoseconds{10'000});
  EXPECT_TRUE(free_threshold(sedp, true).unlimited);
  sedp.initial_data = model::InitialData::pull;
  EXPECT_FALSE(free_threshold(sedp, false).exists);
}

}  // namespace threshold_test
}  // namespace stormproof::timeline
