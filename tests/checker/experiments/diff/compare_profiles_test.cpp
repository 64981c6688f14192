// Which knobs of two profiles differ, where they were written, and what is claimed of the pair
// without running anything.
#include <string>

#include <gtest/gtest.h>

#include "checker/experiments/diff/diff.hpp"

namespace stormproof::diff {
namespace compare_profiles_test {

using model::DdsProfile;
using model::ImplementationKind;
using model::config::TracedProfile;

TracedProfile traced(const DdsProfile& dds) {
  TracedProfile profile;
  profile.value = dds;
  return profile;
}

Comparison compared(const DdsProfile& base, const DdsProfile& candidate) {
  return compare_profiles(traced(base), traced(candidate));
}

const KnobChange* change_of(const Comparison& comparison, const std::string& key) {
  for (const KnobChange& change : comparison.changes) {
    if (change.key == key) return &change;
  }
  return nullptr;
}

TEST(CompareProfiles, AProfileIsIdenticalToItself) {
  const Comparison comparison = compared({}, {});
  EXPECT_EQ(comparison.relation, Relation::identical);
  EXPECT_TRUE(comparison.changes.empty());
  EXPECT_NE(comparison.proof.find("function of the scenario"), std::string::npos);
}

TEST(CompareProfiles, ValuesAreThoseOfFilesAndKeepTheOrderOfTheTable) {
  DdsProfile candidate;
  candidate.descriptors.default_bytes = {model::Bytes{452}, model::Bytes{600}};
  candidate.sedp.heartbeat_response_delay = model::Nanoseconds{10'000'000};
  candidate.sedp.adaptive.epsilon_denominator = 30;
  candidate.spdp.resend = model::SpdpResend::new_only;
  const Comparison comparison = compared({}, candidate);
  ASSERT_EQ(comparison.changes.size(), 4U);
  const auto check = [&](std::size_t k, const char* key, const char* before, const char* after) {
    EXPECT_EQ(comparison.changes[k].key, key);
    EXPECT_EQ(comparison.changes[k].before, before);
    EXPECT_EQ(comparison.changes[k].after, after);
  };
  check(0, "spdp.resend", "all_known", "new_only");
  check(1, "sedp.heartbeat_response_delay", "10us", "10ms");
  check(2, "sedp.adaptive.epsilon", "1/20", "1/30");
  check(3, "descriptors.default_bytes", "[452,532]", "[452,600]");
}

TEST(CompareProfiles, TellsWhatMattersAndWhyNot) {
  DdsProfile candidate;
  candidate.sedp.adaptive.min_period = model::Nanoseconds{50'000'000};
  candidate.sedp.heartbeat_period = model::Nanoseconds{500'000'000};
  const Comparison comparison = compared({}, candidate);
  EXPECT_EQ(comparison.relation, Relation::different);
  EXPECT_TRUE(comparison.proof.empty());
  const KnobChange* const idle = change_of(comparison, "sedp.adaptive.min_period");
  ASSERT_NE(idle, nullptr);
  EXPECT_FALSE(idle->matters);
  EXPECT_NE(idle->why.find("heartbeat_policy: periodic"), std::string::npos);
  const KnobChange* const read = change_of(comparison, "sedp.heartbeat_period");
  ASSERT_NE(read, nullptr);
  EXPECT_TRUE(read->matters);
  EXPECT_TRUE(read->why.empty());
}

TEST(CompareProfiles, AKnobThatOneOfThemReadsMatters) {
  DdsProfile base;
  DdsProfile candidate;
  candidate.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  candidate.sedp.adaptive.min_period = model::Nanoseconds{50'000'000};
  const Comparison comparison = compared(base, candidate);
  EXPECT_TRUE(change_of(comparison, "sedp.adaptive.min_period")->matters);
  EXPECT_TRUE(change_of(comparison, "sedp.heartbeat_policy")->matters);
  EXPECT_TRUE(change_of(compared(candidate, base), "sedp.adaptive.min_period")->matters);
}

TEST(CompareProfiles, UnreadKnobsAloneAreEquivalent) {
  DdsProfile candidate;
  candidate.sedp.adaptive.max_period = model::Nanoseconds{5'000'000'000};
  candidate.sedp.unmatched = model::Unmatched::accept;
  const Comparison comparison = compared({}, candidate);
  EXPECT_EQ(comparison.relation, Relation::equivalent);
  EXPECT_EQ(comparison.changes.size(), 2U);
  EXPECT_NE(comparison.proof.find("normal forms are equal"), std::string::npos);
  for (const KnobChange& change : comparison.changes) {
    EXPECT_FALSE(change.matters) << change.key;
    EXPECT_FALSE(change.why.empty()) << change.key;
  }
  candidate.sedp.relation_opening = model::RelationOpening::each_side;
  EXPECT_EQ(compared({}, candidate).relation, Relation::different);
}

TEST(CompareProfiles, TwoWordsForTheSameGrouping) {
  DdsProfile message;
  message.sedp.grouping_limit_bytes = model::Bytes{1'472};
  DdsProfile mtu;
  mtu.sedp.grouping = model::Grouping::mtu;
  const Comparison same = compared(message, mtu);
  EXPECT_EQ(same.relation, Relation::equivalent);
  EXPECT_FALSE(change_of(same, "sedp.grouping")->matters);
  EXPECT_FALSE(change_of(same, "sedp.grouping")->why.empty());
  EXPECT_FALSE(change_of(same, "sedp.grouping_limit_bytes")->why.empty());
  // Against the default limit the word does matter.
  const Comparison other = compared({}, mtu);
  EXPECT_EQ(other.relation, Relation::different);
  EXPECT_TRUE(change_of(other, "sedp.grouping")->matters);
}

TEST(CompareProfiles, UnmodelledSettingsAreNeverCalledEqual) {
  DdsProfile base;
  base.unmodelled["peers"] = "unicast discovery";
  DdsProfile candidate;
  candidate.unmodelled["interface"] = "two channels";
  const Comparison comparison = compared(base, candidate);
  EXPECT_EQ(comparison.relation, Relation::unmodelled);
  ASSERT_EQ(comparison.changes.size(), 2U);
  const KnobChange* const gone = change_of(comparison, "unmodelled.peers");
  ASSERT_NE(gone, nullptr);
  EXPECT_EQ(gone->before, "unicast discovery");
  EXPECT_EQ(gone->after, "–");
  EXPECT_FALSE(gone->matters);
  EXPECT_FALSE(gone->modelled);
  EXPECT_FALSE(gone->why.empty());
  EXPECT_EQ(change_of(comparison, "unmodelled.interface")->before, "–");
  // A difference in the model is one, whatever else differs.
  candidate.spdp.startup_announcements = 1;
  EXPECT_EQ(compared(base, candidate).relation, Relation::different);
}

/// A lease acts where somebody leaves or the network fails: neither "the same everywhere" nor
/// unknown.
TEST(CompareProfiles, LeasesDifferElsewhere) {
  const auto with_lease = [](std::int64_t seconds, ImplementationKind kind) {
    DdsProfile dds;
    dds.implementation = kind;
    dds.spdp.lease = model::Nanoseconds{seconds * 1'000'000'000};
    return dds;
  };
  for (const ImplementationKind kind : {ImplementationKind::fastdds, ImplementationKind::cyclone}) {
    const Comparison longer = compared(with_lease(15, kind), with_lease(300, kind));
    EXPECT_EQ(longer.relation, Relation::elsewhere);
    for (const char* word : {"ghost", "for 15s", "for 300s", "was not run"}) {
      EXPECT_NE(longer.proof.find(word), std::string::npos) << longer.proof;
    }
    EXPECT_FALSE(change_of(longer, "spdp.lease")->matters);
    EXPECT_EQ(compared(with_lease(30, kind), with_lease(5, kind)).relation, Relation::elsewhere);
  }
  DdsProfile usual;
  usual.implementation = ImplementationKind::fastdds;
  EXPECT_EQ(compared(usual, with_lease(20, ImplementationKind::fastdds)).relation,
            Relation::equivalent);
  DdsProfile few = usual;
  few.max_participants_per_host = 4;
  EXPECT_EQ(compared(usual, few).relation, Relation::elsewhere);
}

TEST(CompareProfiles, ImplementationsHaveDifferentKnobs) {
  DdsProfile fastdds;
  fastdds.implementation = ImplementationKind::fastdds;
  for (const bool turned : {false, true}) {
    const Comparison comparison =
        turned ? compared(fastdds, DdsProfile{}) : compared(DdsProfile{}, fastdds);
    EXPECT_EQ(comparison.relation, Relation::different);
    ASSERT_FALSE(comparison.changes.empty());
    EXPECT_EQ(comparison.changes.front().key, "implementation");
    const KnobChange* const only = change_of(comparison, "sedp.acknack_bytes");
    ASSERT_NE(only, nullptr);
    EXPECT_EQ(turned ? only->before : only->after, "–");
    EXPECT_TRUE(only->matters);
  }
}

TEST(CompareProfiles, KeepsThePlaces) {
  const auto file = std::make_shared<const std::string>("robots.xml");
  DdsProfile changed;
  changed.spdp.period = model::Nanoseconds{1'000'000'000};
  TracedProfile candidate = traced(changed);
  candidate.places["spdp.period"] = {file, 12, 7};
  const Comparison comparison = compare_profiles(traced({}), candidate);
  ASSERT_EQ(comparison.changes.size(), 1U);
  EXPECT_EQ(comparison.changes.front().after_place.to_string(), "robots.xml:12:7");
  EXPECT_EQ(comparison.changes.front().before_place.line, 0);
}

}  // namespace compare_profiles_test
}  // namespace stormproof::diff
