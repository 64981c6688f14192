// Rows that say what happened in a run, an outage or a process that went: they are read, become
// lives of the deployment, and what the model says of them is near what was measured.
#include "checker/evidence/coverage/change.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include "checker/evidence/coverage/study.hpp"
#include "examples.hpp"
#include "model/config/scenario_file.hpp"

namespace stormproof::prediction {
namespace change_test {

const std::string head = R"({"N_H":2,"N_P":2,"N_E":2,"T_app_ms":9,)";

Observation row_of(const std::string& rest) {
  const auto read = read_text(head + rest + "}");
  EXPECT_TRUE(read) << to_string(read.error());
  return read ? read->rows.front() : Observation{};
}
std::string error_of(const std::string& rest) {
  const auto read = read_text(head + rest + "}");
  return read ? "no error" : to_string(read.error());
}
std::optional<double> value(const Observation& run, Measure measure) {
  return run.values[statistics::index_of(measure)];
}

TEST(Changes, AnOutageIsReadWithWhatCameOfIt) {
  const Observation run = row_of(
      R"("outage_ms":[6000,36000],"outage_scope":"host 1","recovery_ms":1500.5,"lost_pairs":8,)"
      R"("phases":{"before":{"sent":{"total":7}},"after":{"sent":{"total":9}}})");
  EXPECT_EQ(run.change.outage, (Range{6000, 36000}));
  EXPECT_EQ(run.change.cut_off, 1U);
  EXPECT_EQ(value(run, Measure::recovery), 1500.5);
  EXPECT_EQ(value(run, Measure::lost_pairs), 8);
  EXPECT_EQ(value(run, Measure::messages_before), 7);
  EXPECT_FALSE(value(run, Measure::messages_during));
  EXPECT_EQ(value(run, Measure::messages_after), 9);
}

TEST(Changes, WhoNeverRecoveredIsNotForgotten) {
  EXPECT_EQ(value(row_of(R"("outage_ms":[6,7],"recovery_ms":null)"), Measure::recovery), never);
  EXPECT_FALSE(value(row_of(R"("outage_ms":[6,7])"), Measure::recovery));
  EXPECT_FALSE(value(row_of(R"("recovery_ms":5)"), Measure::recovery));  // nothing happened
}

TEST(Changes, AProcessThatComesBackIsAnotherOne) {
  const Observation run = row_of(
      R"("leave":{"host":1,"id":0,"at":5000,"at_ms":5003,"back":1000,"how":"kill"},"procs":[)"
      R"({"host":0,"id":0,"enabled":3,"endpoints_done":4},{"host":0,"id":1,"enabled":2,)"
      R"("endpoints_done":9},{"host":1,"id":0,"enabled":6002,"endpoints_done":6007},)"
      R"({"host":1,"id":1,"enabled":1,"endpoints_done":2}])");
  ASSERT_TRUE(run.change.departure);
  EXPECT_EQ(run.change.departure->at, 5003);
  EXPECT_EQ(run.change.departure->back, 6002);
  ASSERT_EQ(run.participants.size(), 4U);
  EXPECT_EQ(run.participants[2].start, 2);  // the one before it began as it did
  EXPECT_EQ(run.participants[2].endpoints_done, 7);
  EXPECT_EQ(run.start->high, 3);
}

TEST(Changes, MistakesAreRefused) {
  EXPECT_EQ(error_of(R"("outage_ms":[6,5])"),
            "runs.jsonl:1: outage_ms is [6,5]; expected [earliest, latest], two ascending times in "
            "ms from 0 to 3600000");
  EXPECT_EQ(error_of(R"("outage_ms":[5,6],"outage_scope":"host 2")"),
            R"(runs.jsonl:1: outage_scope is "host 2"; expected all, or host N with N up to 1)");
  EXPECT_NE(error_of(R"("leave":{"host":1,"id":0,"at":5,"how":"quit"})")
                .find(R"(how is "quit"; expected kill or leave)"),
            std::string::npos);
  EXPECT_NE(error_of(R"("leave":{"host":1,"id":2,"at":5,"how":"kill"})").find("id is 2"),
            std::string::npos);
  EXPECT_NE(error_of(R"("leave":{"host":1,"id":0,"how":"kill"})").find("at_ms is missing"),
            std::string::npos);
  EXPECT_NE(error_of(R"("outage_ms":[5,6],"leave":{"host":1,"id":0,"at":5,"how":"kill"})")
                .find("not both"),
            std::string::npos);
}

TEST(Changes, OfDifferentLengthsAreNotPooled) {
  const auto read = read_text(head + R"("outage_ms":[5,6]})" + "\n" + head +
                              R"("outage_ms":[5,7]})" + "\n" + head + R"("outage_ms":[5,6]})");
  ASSERT_TRUE(read);
  EXPECT_EQ(configurations(read->rows).size(), 2U);
}

model::Life life_of(const std::string& rest, const std::string& dds = "fastdds-2.6.11") {
  const auto read = read_text(head + rest + "}");
  const auto scenario = scenario_of(configurations(read->rows).front(), {dds, "emulated-ap", {}});
  EXPECT_TRUE(scenario) << to_string(scenario.error());
  return scenario->deployment.life.value_or(model::Life{});
}

TEST(Changes, BecomeLives) {
  EXPECT_EQ(life_of(R"("outage_ms":[5,6])").outages.size(), 1U);
  const model::Life one_host = life_of(R"("outage_ms":[5,6],"outage_scope":"host 1")");
  ASSERT_EQ(one_host.outages.size(), 2U);
  EXPECT_EQ(one_host.outages[0].from_reach, model::Reach::host);
  EXPECT_EQ(one_host.outages[1].to, 1U);
  EXPECT_EQ(one_host.outages[1].end, model::Nanoseconds{6'000'000});
  EXPECT_EQ(life_of(R"("leave":{"host":1,"id":1,"at":5000,"how":"kill"})").mute.front(),
            (model::Mute{3, model::Nanoseconds{5'000'000'000}}));
  EXPECT_EQ(life_of(R"("leave":{"host":1,"id":1,"at":5000,"how":"leave"})", "cyclonedds-0.10")
                .leaves.front()
                .participant,
            3U);
}

/// Who says goodbye to a Discovery Server is not in the rules: such a row is skipped, not run as if
/// it had been killed.
TEST(Changes, WhatRulesDoNotKnowIsSkipped) {
  const auto read = read_text(head + R"("leave":{"host":1,"id":1,"at":5000,"how":"leave"}})");
  StudyRequest request;
  request.dds = {"fastdds-server-2.6.11"};
  request.wireless = "emulated-ap";
  const auto found = study(read->rows, {}, request);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->profiles.front().skipped.at("a process that goes"), 1U);
}

TEST(Changes, NearIsAFactorOrAMoment) {
  EXPECT_TRUE(is_near(Measure::recovery, 0, 299));
  EXPECT_FALSE(is_near(Measure::recovery, 0, 301));
  EXPECT_TRUE(is_near(Measure::recovery, 2400, 3000));
  EXPECT_FALSE(is_near(Measure::recovery, 2300, 3000));
  EXPECT_FALSE(is_near(Measure::lost_pairs, 17, 18));
  EXPECT_TRUE(is_near(Measure::lost_pairs, 18, 18));
  EXPECT_FALSE(is_near(Measure::messages_after, 1, 3));
  EXPECT_FALSE(is_near(Measure::recovery, statistics::unreached, 3000));
}

/// What a run says of an outage, of a fleet that is worked out by hand in museum.md: both forget
/// each other, and the announcement at 40.0 s is the first that arrives.
TEST(Changes, WhatCameOfThemInARun) {
  const auto read = model::config::parse_scenario(
      "{deployment: {participants: [{host: 0, publications: 1, subscriptions: 1}, {host: 1, "
      "publications: 1, subscriptions: 1, start: 500ms}]}, dds: fastdds-2.6.11, wireless: {kind: "
      "constant_delay, one_way: 100us}, time_limit: 100s}",
      "two", {}, model::config::SpecPath::standard());
  ASSERT_TRUE(read) << to_string(read.error());
  model::Scenario scenario = *read;
  Change change;
  change.outage = Range{9900, 39900};
  put(change, 1, scenario);
  MeasureValues values;
  trials::Runner runner{1};
  add_values(change, *run_changed(runner, change, scenario), values);
  EXPECT_NEAR(values[statistics::index_of(Measure::recovery)].value(), 100.61, 1e-6);
  EXPECT_EQ(values[statistics::index_of(Measure::lost_pairs)], 2);
  EXPECT_GT(values[statistics::index_of(Measure::messages_during)].value(), 0);
}

/// Live fleets, each run beside one of the model that starts as it did: how soon all is recovered,
/// and who forgets whom.
TEST(Changes, OfLiveFleetsArePredicted) {
  struct Set {
    const char* name;
    const char* dds;
    double recovery;    ///< share of runs that are near, at least
    double lost_pairs;  ///< the same
  };
  for (const Set& set : {Set{"chg_simple_2145", "fastdds-2.14.5", 1, 1},
                         Set{"chg_client", "fastdds-server-2.6.11", 0.9, 1},
                         Set{"chg_cyc_uc", "cyclonedds-0.10", 0.9, 0.8},
                         Set{"chg_kill_client", "fastdds-server-2.6.11", 1, 1},
                         Set{"chg_kill_cyc_mc", "cyclonedds-0.10-multicast", 1, 1}}) {
    std::ifstream input{STORMPROOF_SPECS_DIR "/observations/changes.jsonl"};
    const auto rows = read_observations(input, "changes",
                                        {CompletionTime::app, {std::string{"set="} + set.name}});
    ASSERT_TRUE(rows) << to_string(rows.error());
    StudyRequest request;
    request.dds = {set.dds};
    request.wireless = "emulated-ap";
    request.scopes = {"all"};
    request.predict.samples = 1;
    const auto found = study(rows->rows, {}, request);
    ASSERT_TRUE(found) << to_string(found.error());
    std::size_t judged = 0;
    for (const FitRow& row : found->profiles.front().rows) {
      if (row.measure == Measure::recovery) {
        EXPECT_GE(row.fit.near.value(), set.recovery) << set.name;
      } else if (row.measure == Measure::lost_pairs) {
        EXPECT_GE(row.fit.near.value(), set.lost_pairs) << set.name;
      } else {
        continue;
      }
      ++judged;
    }
    EXPECT_EQ(judged, 2U) << set.name;
  }
}

}  // namespace change_test
}  // namespace stormproof::prediction
