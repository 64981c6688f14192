// The section `amendments` of a profile and `life` of a deployment: what is read, what is refused,
// and what is written is what was read.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "model/config/knobs/effective.hpp"
#include "model/config/scenario_file.hpp"
#include "model/implementations.hpp"
#include "model/life.hpp"
#include "tests/model/config/test_files.hpp"

namespace stormproof::model::config {
namespace amendments_test {

Result<Scenario> with(const std::vector<std::string>& overrides) {
  return read_scenario("smallest", overrides, source_specs());
}
std::string refusal(const std::vector<std::string>& overrides) {
  const auto scenario = with(overrides);
  return scenario ? "" : scenario.error().message;
}

TEST(Amendments, AreAbsentUnlessAProfileHasThem) {
  const auto scenario = with({});
  ASSERT_TRUE(scenario);
  EXPECT_FALSE(scenario->dds.amendments);
  EXPECT_FALSE(scenario->deployment.life);
}

TEST(Amendments, AreThoseOfThePaperUnlessTheySayOtherwise) {
  const auto scenario = with({"dds.amendments={}"});
  ASSERT_TRUE(scenario) << to_string(scenario.error());
  EXPECT_EQ(scenario->dds.amendments, Amendments{});
}

TEST(Amendments, AreReadAndWritten) {
  const auto scenario =
      with({"dds.amendments={acked_request: reopen, resend_copies: 4, "
            "suppression_end_arms: false, reader_nack_delay: 100ms}"});
  ASSERT_TRUE(scenario) << to_string(scenario.error());
  EXPECT_EQ(scenario->dds.amendments->acked_request, AckedRequest::reopen);
  EXPECT_EQ(scenario->dds.amendments->resend_copies, 4U);
  EXPECT_EQ(scenario->dds.amendments->suppression_end_arms, Whether::no);
  EXPECT_EQ(scenario->dds.amendments->reader_nack_delay, Nanoseconds{100'000'000});
  const auto again = parse_scenario(effective_json(*scenario).dump(), "again", {}, source_specs());
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_EQ(*again, *scenario);
}

TEST(Amendments, AreOfThePaperOnly) {
  EXPECT_NE(refusal({"dds=fastdds-2.6.11", "dds.amendments={}"})
                .find("only implementation: paper has this key"),
            std::string::npos);
}

TEST(Amendments, AnAckNackCannotAnswerAHeartbeatInData) {
  EXPECT_NE(refusal({"dds.amendments={stale_acknack: latest_only}"}).find("piggyback: off"),
            std::string::npos);
  EXPECT_EQ(refusal({"dds.amendments={stale_acknack: latest_only}", "dds.sedp.piggyback=off"}), "");
}

TEST(Amendments, OneClockOfHeartbeatsIsMeasured) {
  const std::string measured = "dds.amendments={heartbeat_policy: measured_ack}";
  EXPECT_EQ(refusal({measured}), "");
  for (const char* other :
       {"dds.sedp.heartbeat_policy=adaptive", "dds.sedp.heartbeat_timer=additive"}) {
    EXPECT_NE(refusal({measured, other})
                  .find("'measured_ack'; expected of_the_profile, or sedp.heartbeat_policy: "
                        "periodic and heartbeat_timer: single"),
              std::string::npos)
        << refusal({measured, other});
  }
}

TEST(Life, IsReadAndWritten) {
  const auto scenario = with({"dds.amendments={}",
                              "deployment.life={stale: [{writer: 0, reader: 1}], mute: "
                              "[{participant: 1, from: 2s}], outages: [{from: 1, to: 0, start: "
                              "1s, end: 3s}]}"});
  ASSERT_TRUE(scenario) << to_string(scenario.error());
  const Life& life = *scenario->deployment.life;
  EXPECT_EQ(life.stale, (std::vector<StaleRelation>{{0, 1}}));
  EXPECT_EQ(life.mute, (std::vector<Mute>{{1, Nanoseconds{2'000'000'000}}}));
  EXPECT_EQ(life.outages,
            (std::vector<Outage>{{1, 0, Nanoseconds{1'000'000'000}, Nanoseconds{3'000'000'000}}}));
  const auto again = parse_scenario(effective_json(*scenario).dump(), "again", {}, source_specs());
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_EQ(*again, *scenario);
}

TEST(Life, HasLeasesAndRestarts) {
  const auto scenario =
      with({"dds.amendments={}",
            "deployment.life={lease: 20s, leases: [{participant: 1, duration: 5s}], "
            "restarts: [{participant: 0, stop: 1s, start: 2s}, {participant: 1, "
            "stop: 3s, start: 4s, identity: new}]}"});
  ASSERT_TRUE(scenario) << to_string(scenario.error());
  const Life& life = *scenario->deployment.life;
  const auto seconds = [](std::int64_t count) { return Nanoseconds{count * 1'000'000'000}; };
  EXPECT_EQ(life.lease, seconds(20));
  EXPECT_EQ(life.leases, (std::vector<Lease>{{1, seconds(5)}}));
  EXPECT_EQ(life.restarts, (std::vector<Restart>{{0, seconds(1), seconds(2), Identity::same},
                                                 {1, seconds(3), seconds(4), Identity::fresh}}));
  const auto again = parse_scenario(effective_json(*scenario).dump(), "again", {}, source_specs());
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_EQ(*again, *scenario);
}

TEST(Life, RefusesRestartsThatCannotBe) {
  const std::string rules = "dds.amendments={}";
  const auto refused = [&](const std::string& restarts) {
    return refusal({rules, "deployment.life={restarts: [" + restarts + "]}"});
  };
  EXPECT_NE(refused("{participant: 0, stop: 2s, start: 2s}").find("later than its stop"),
            std::string::npos);
  EXPECT_NE(refused("{participant: 9, stop: 1s, start: 2s}").find("participants of the deployment"),
            std::string::npos);
  EXPECT_NE(refused("{participant: 0, stop: 1s, start: 4s}, {participant: 0, stop: 3s, start: 5s}")
                .find("one after the other"),
            std::string::npos);
  EXPECT_NE(refusal({rules, "deployment.life={leases: [{participant: 9, duration: 1s}]}"})
                .find("participants of the deployment"),
            std::string::npos);
  EXPECT_NE(refusal({"vary={outages: 1}"}).find("a DDS profile whose rules know it"),
            std::string::npos);
  for (const char* key : {"vary={new_endpoints: 1}",
                          "deployment.life={endpoints: [{participant: 0, publications: 1, "
                          "subscriptions: 0, at: 1s}]}"}) {
    EXPECT_NE(refusal({"dds=fastdds-2.6.11", key}).find("a DDS profile with amendments"),
              std::string::npos)
        << key;
  }
}

TEST(Life, HasEndpoints) {
  const auto scenario =
      with({"dds.amendments={}",
            "deployment.life={endpoints: [{participant: 1, publications: 2, subscriptions: 0, at: "
            "1s}, {participant: 0, publications: 0, subscriptions: 1, at: 2s, until: 3s}]}"});
  ASSERT_TRUE(scenario) << to_string(scenario.error());
  const auto seconds = [](std::int64_t count) { return Nanoseconds{count * 1'000'000'000}; };
  EXPECT_EQ(
      scenario->deployment.life->endpoints,
      (std::vector<LateEndpoints>{{1, 2, 0, seconds(1), {}}, {0, 0, 1, seconds(2), seconds(3)}}));
  const auto again = parse_scenario(effective_json(*scenario).dump(), "again", {}, source_specs());
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_EQ(*again, *scenario);
}

TEST(Life, RefusesEndpointsOfWhoIsNotThere) {
  const auto refused = [&](const std::string& times, const std::string& others = "") {
    return refusal({"dds.amendments={}", "deployment.life={" + others +
                                             "endpoints: [{publications: 1, subscriptions: 0, " +
                                             times + "}]}"});
  };
  EXPECT_EQ(refused("participant: 1, at: 1s"), "");
  EXPECT_NE(refused("participant: 1, at: 2s, until: 2s").find("later than their creation"),
            std::string::npos);
  const char* const absent = "not while they are away";
  EXPECT_NE(refused("participant: 9, at: 2s").find(absent), std::string::npos);
  const std::string mute = "mute: [{participant: 1, from: 3s}], ";
  EXPECT_EQ(refused("participant: 1, at: 2s", mute), "");
  EXPECT_NE(refused("participant: 1, at: 2s, until: 3s", mute).find(absent), std::string::npos);
  const std::string restart = "restarts: [{participant: 1, stop: 2s, start: 4s}], ";
  EXPECT_NE(refused("participant: 1, at: 3s", restart).find(absent), std::string::npos);
  EXPECT_EQ(refused("participant: 1, at: 4s", restart), "");
  EXPECT_NE(refusal({"vary={new_endpoints: 1}"}).find("a DDS profile with amendments"),
            std::string::npos);
  auto scenario = with({"dds.amendments={}",
                        "deployment.life={endpoints: [{participant: 1, publications: 1, "
                        "subscriptions: 0, at: 1s}]}"});
  ASSERT_TRUE(scenario);
  EXPECT_TRUE(creates_while_there(scenario->deployment));
  scenario->deployment.participants[1].start = Nanoseconds{1'000'000'001};
  EXPECT_FALSE(creates_while_there(scenario->deployment));
}

TEST(Life, NeedsRulesThatKnowIt) {
  EXPECT_NE(refusal({"deployment.life={}"}).find("a DDS profile whose rules know it"),
            std::string::npos);
}

TEST(Life, IsOfParticipantsThatThereAre) {
  const std::string rules = "dds.amendments={}";
  EXPECT_NE(refusal({rules, "deployment.life={stale: [{writer: 0, reader: 9}]}"})
                .find("participants of different hosts"),
            std::string::npos);
  EXPECT_NE(refusal({rules, "deployment.life={stale: [{writer: 0, reader: 0}]}"})
                .find("participants of different hosts"),
            std::string::npos);
  EXPECT_NE(refusal({rules, "deployment.life={mute: [{participant: 9, from: 0s}]}"})
                .find("participants of the deployment"),
            std::string::npos);
  EXPECT_NE(refusal({rules, "deployment.life={outages: [{from: 0, to: 1, start: 2s, end: 1s}]}"})
                .find("not before its start"),
            std::string::npos);
}

}  // namespace amendments_test
}  // namespace stormproof::model::config
