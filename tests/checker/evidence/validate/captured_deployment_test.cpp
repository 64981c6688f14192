// The deployment that a capture shows: exact for shipped captures, unequal participants, refusals.
#include "checker/evidence/validate/captured_deployment.hpp"

#include <gtest/gtest.h>

#include "checker/evidence/validate/observation.hpp"
#include "tests/checker/evidence/validate/invented.hpp"

namespace stormproof::validate::testing {
namespace captured_deployment_test {

constexpr std::int64_t always = INT64_MAX;
const model::DescriptorProfile defaults{};  // 9 publications, 8 subscriptions

capture::Conversation shipped(const std::string& name) {
  const std::string file = std::string{STORMPROOF_CAPTURES_DIR} + "/" + name + ".pcap.xz";
  auto conversation = capture::read_conversation(std::span{&file, 1});
  EXPECT_TRUE(conversation) << to_string(conversation.error());
  return *conversation;
}

TEST(CapturedDeployment, ShippedCaptureGivesItsScenario) {
  const auto conversation = shipped("fastdds2611_ap150_np2_ne20_r0");
  const auto found = captured_deployment(conversation, always);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->hosts, 2U);
  const auto participants = model_participants(*found, defaults);
  ASSERT_EQ(participants.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(participants[k].host.value, k / 2);
    EXPECT_EQ(participants[k].publications, 10U);
    EXPECT_EQ(participants[k].subscriptions, 10U);
    EXPECT_LE(participants[k].start, participants[k].endpoints_done);
    EXPECT_EQ(found->participants[k].created_earliest, found->participants[k].created_latest);
    EXPECT_GT(found->participants[k].creations_seen, 20U);
  }
  EXPECT_EQ(participants[0].start.count(), 0);
  EXPECT_NEAR(static_cast<double>(participants[3].start.count()), 6.2e6, 1e5);
}

TEST(CapturedDeployment, SmallestShippedCapture) {
  const auto found = captured_deployment(shipped("fastdds2611_ap150_np1_ne2_r0"), always);
  ASSERT_TRUE(found);
  const auto participants = model_participants(*found, defaults);
  ASSERT_EQ(participants.size(), 2U);
  EXPECT_EQ(participants[0].publications, 1U);
  EXPECT_EQ(participants[1].subscriptions, 1U);
}

TEST(CapturedDeployment, UnequalParticipantsStayUnequal) {
  Invented invented = two_hosts();
  invented.describes_all(0, pubs, 12, 1, 10 * ms).describes_all(0, subs, 8, 1, 11 * ms);
  invented.describes_all(1, pubs, 9, 0, 12 * ms).describes_all(1, subs, 11, 0, 20 * ms);
  const auto found = captured_deployment(invented.conversation(), always);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->zero_ns, 1 * ms);
  const auto participants = model_participants(*found, defaults);
  EXPECT_EQ(participants[0].publications, 3U);
  EXPECT_EQ(participants[0].subscriptions, 0U);
  EXPECT_EQ(participants[0].endpoints_done.count(), 10 * ms);
  EXPECT_EQ(participants[1].publications, 0U);
  EXPECT_EQ(participants[1].subscriptions, 3U);
  EXPECT_EQ(participants[1].start.count(), 2 * ms);
  EXPECT_EQ(participants[1].endpoints_done.count(), 19 * ms);
}

TEST(CapturedDeployment, UnevenCreationWidensTheRange) {
  Invented even = two_hosts();
  // 17 endpoints at equal intervals of 1 ms would end at 18 ms; these are created all at once.
  even.describes_all(0, pubs, 9, 1, 18 * ms).describes_all(0, subs, 8, 1, 18 * ms);
  const auto found = captured_deployment(even.conversation(), always);
  ASSERT_TRUE(found);
  const CapturedParticipant& one = found->participants[0];
  EXPECT_EQ(one.created_latest.count(), 17 * ms);
  EXPECT_EQ(one.unevenness.count(), 16 * ms);  // the first one, 16 ms late
  EXPECT_EQ(one.done_earliest().count(), 1 * ms);
  EXPECT_EQ(one.done_latest().count(), 33 * ms);
}

TEST(CapturedDeployment, FewerEndpointsThanADefaultNodeBecomeTheDefaults) {
  Invented invented = two_hosts();
  invented.describes_all(0, pubs, 2, 1, 10 * ms);
  const auto found = captured_deployment(invented.conversation(), always);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->participants[0].publications, 2U);
  EXPECT_EQ(model_participants(*found, defaults)[0].publications, 0U);
}

TEST(CapturedDeployment, RefusesWhatCannotBePredicted) {
  Invented silent;
  silent.participant(0).participant(1).describes(0, pubs, 1, 1, 10 * ms);
  const auto no_spdp = captured_deployment(silent.conversation(), always);
  ASSERT_FALSE(no_spdp);
  EXPECT_NE(no_spdp.error().message.find("announces itself"), std::string::npos);
  Invented together;
  together.participant(0).participant(0).announces(0, ms).announces(1, 2 * ms);
  const auto one_host = captured_deployment(together.conversation(), always);
  ASSERT_FALSE(one_host);
  EXPECT_NE(one_host.error().message.find("one host"), std::string::npos);
  Invented invented = two_hosts();
  EXPECT_FALSE(captured_deployment(invented.conversation(), 0)) << "cut before the first one";
}

TEST(Observation, EndsWithTheLastInitialDataUnlessTheCutIsGiven) {
  Invented invented = two_hosts();
  invented.describes(0, pubs, 1, 1, 10 * ms).describes(1, pubs, 1, 0, 20 * ms);
  invented.describes(1, pubs, 1, 0, 30 * ms);  // a repair
  const auto by_default = observe(invented.conversation(), {});
  ASSERT_TRUE(by_default);
  EXPECT_EQ(by_default->completion_ns(), 19 * ms);
  EXPECT_EQ(by_default->values[index_of(Figure::repair_data)], 0.0);
  const auto given = observe(invented.conversation(), 30 * ms);
  ASSERT_TRUE(given);
  EXPECT_EQ(given->completion_ns(), 29 * ms);
  EXPECT_EQ(given->values[index_of(Figure::repair_data)], 1.0);
  EXPECT_EQ(given->values[index_of(Figure::last_initial)], 19.0 * ms);
  EXPECT_TRUE(given->complete);
}

TEST(Observation, RefusesACutThatIsNoDiscovery) {
  Invented invented = two_hosts();
  invented.describes(0, pubs, 1, 1, 10 * ms);
  EXPECT_FALSE(observe(invented.conversation(), INT64_MAX));
  EXPECT_TRUE(observe(invented.conversation(), 1'000'000 * ms));
}

TEST(Observation, SurvivesImpossibleSequenceNumbers) {
  Invented invented = two_hosts();
  invented.describes(0, pubs, -5, 1, 10 * ms).describes(1, pubs, 0, 0, 12 * ms);
  const auto observation = observe(invented.conversation(), {});
  ASSERT_TRUE(observation);
  EXPECT_EQ(observation->deployment.participants[0].created_latest.count(), 9 * ms);
}

TEST(Observation, MissingDescriptorsMakeItIncomplete) {
  Invented invented = two_hosts();
  invented.heartbeat(0, pubs, 2, 1, 10 * ms).describes(0, pubs, 1, 1, 20 * ms);
  const auto observation = observe(invented.conversation(), {});
  ASSERT_TRUE(observation);
  EXPECT_FALSE(observation->complete);
  EXPECT_EQ(observation->counting.missing_count, 1U);
}

TEST(Observation, TellsPulledFromPushed) {
  Invented invented = two_hosts();
  invented.asks(1, pubs, 1, 0, 5 * ms).describes(0, pubs, 1, 1, 10 * ms);
  invented.describes(0, pubs, 2, 1, 20 * ms);
  const auto observation = observe(invented.conversation(), {});
  ASSERT_TRUE(observation);
  EXPECT_EQ(observation->values[index_of(Figure::initial_data)], 2.0);
  EXPECT_EQ(observation->values[index_of(Figure::initial_pulled)], 1.0);
  EXPECT_FALSE(observation->values[index_of(Figure::user_control)]) << "none in the capture";
}

}  // namespace captured_deployment_test
}  // namespace stormproof::validate::testing
