// Rows of anyone's measurements are read, and what is wrong with a row is said with its line.
#include <gtest/gtest.h>

#include "examples.hpp"

namespace stormproof::prediction {
namespace observation_test {

std::optional<double> value(const Observation& run, Measure measure) {
  return run.values[static_cast<std::size_t>(measure)];
}

std::string error_of(const std::string& text, const ReadOptions& options = {}) {
  const auto read = read_text(text, options);
  return read ? "no error" : to_string(read.error());
}

TEST(Observations, FourFieldsAreEnough) {
  const auto read = read_text(R"({"N_H":2,"N_P":3,"N_E":4,"completion_ms":12.5})");
  ASSERT_TRUE(read);
  const Observation& run = read->rows.front();
  EXPECT_TRUE(run.completed);
  EXPECT_EQ(run.participants_per_host, 3U);
  EXPECT_EQ(value(run, Measure::completion), 12.5);
  EXPECT_FALSE(value(run, Measure::messages));
}

TEST(Observations, ProcessesSayWhenTheyAnnounceThemselves) {
  const std::string run = R"({"N_H":2,"N_P":1,"N_E":2,"T_app_ms":9,)";
  const std::string both =
      R"("procs":[{"create_start":1,"enabled":4},{"enabled":3},{"cpu_ms":3}]})";
  const auto read = read_text(run + both);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->rows[0].start->low, 3);
  EXPECT_EQ(read->rows[0].start->high, 4);
  EXPECT_EQ(read_text(run + R"("start_ms":[5,6],)" + both)->rows[0].start->low, 5);
  EXPECT_FALSE(read_text(run + R"("procs":[{"cpu_ms":3}]})")->rows[0].start);
  EXPECT_EQ(error_of(run + R"("procs":7})"),
            "runs.jsonl:1: procs is 7; expected a list of objects, one of each process");
  EXPECT_EQ(error_of(run + R"("procs":[{"enabled":-4}]})"),
            R"(runs.jsonl:1: procs is [{"enabled":-4}]; expected in it: enabled is -4; expected a )"
            "time in ms from 0 to 3600000");
}

TEST(Observations, ProcessesSayWhenEachParticipantStartedAndHadItsEndpoints) {
  const std::string run = R"({"N_H":2,"N_P":1,"N_E":2,"T_app_ms":9,"procs":[)";
  const std::string second = R"({"host":1,"id":0,"enabled":4,"endpoints_done":7})";
  const std::string first = R"({"host":0,"id":0,"enabled":3,"endpoints_done":5})";
  const auto read = read_text(run + second + "," + first + "]}");
  ASSERT_TRUE(read);
  const std::vector<Times>& times = read->rows[0].participants;
  ASSERT_EQ(times.size(), 2U);
  EXPECT_EQ(times[0].start, 3);
  EXPECT_EQ(times[1].endpoints_done, 7);
  EXPECT_TRUE(read_text(run + first + "]}")->rows[0].participants.empty());
  EXPECT_NE(error_of(run + R"({"host":2,"id":0,"enabled":3,"endpoints_done":5}]})")
                .find("host is 2; expected an integer from 0 to 1"),
            std::string::npos);
  EXPECT_NE(error_of(run + R"({"host":0,"id":0,"enabled":3,"endpoints_done":2}]})")
                .find("endpoints_done is 2; expected a time in ms, up to 3600000 and not before"),
            std::string::npos);
}

TEST(Observations, StartsThatFollowOneAnotherAreOtherConfigurations) {
  const std::string run = R"({"N_H":2,"N_P":2,"N_E":2,"T_app_ms":9,"step_ms":)";
  const auto read = read_text(run + "0}\n" + run + "100}\n" + run + R"(100,"step_by":"host"})");
  ASSERT_TRUE(read);
  EXPECT_EQ(configurations(read->rows).size(), 3U);
  EXPECT_EQ(read->rows[1].spread.planned(1, 3), 300);
  EXPECT_EQ(read->rows[2].spread.planned(1, 3), 100);
  EXPECT_EQ(error_of(run + R"(100,"step_by":"robot"})"),
            R"(runs.jsonl:1: step_by is "robot"; expected process or host)");
}

TEST(Observations, TotalIsTheSumOfAllClasses) {
  const auto read = read_text(
      R"({"N_H":2,"N_P":1,"N_E":2,"T_app_ms":9,"counts":{"spdp_m":1,"spdp_unicast":2,"init":3,)"
      R"("repair":4,"heartbeat":5,"ack":6}})");
  ASSERT_TRUE(read);
  EXPECT_EQ(value(read->rows[0], Measure::messages), 21);
  EXPECT_EQ(value(read->rows[0], Measure::spdp_unicast), 2);
}

TEST(Observations, ARunThatWasCutOffHasLowerBounds) {
  const auto read =
      read_text(R"({"N_H":2,"N_P":1,"N_E":2,"completed":false,"T_app_ms":null,"limit_s":16})");
  ASSERT_TRUE(read);
  EXPECT_FALSE(read->rows[0].completed);
  EXPECT_EQ(value(read->rows[0], Measure::completion), 16'000);
  EXPECT_EQ(observed_values(configurations(read->rows)[0], Measure::completion),
            std::vector<double>{never});
}

TEST(Observations, TheCountsOfARunThatWasCutOffAreThoseUpToItsLimit) {
  const std::string cut = R"({"N_H":2,"N_P":1,"N_E":2,"completed":false,"counts":{"total":7})";
  const auto read = read_text(cut + R"(,"limit_s":16})");
  ASSERT_TRUE(read);
  const Configuration configuration = configurations(read->rows)[0];
  EXPECT_EQ(configuration.limit(), 16'000);
  EXPECT_EQ(observed_values(configuration, Measure::messages), std::vector<double>{7});
  const Configuration unlimited = configurations(read_text(cut + "}")->rows)[0];
  EXPECT_FALSE(unlimited.limit());
  EXPECT_EQ(observed_values(unlimited, Measure::messages), std::vector<double>{never});
}

TEST(Observations, StrictCompletionIsAnotherField) {
  const std::string row = R"({"N_H":2,"N_P":1,"N_E":2,"T_app_ms":9,"T_strict_ms":8})";
  EXPECT_EQ(value(read_text(row)->rows[0], Measure::completion), 9);
  const auto strict = read_text(row, {CompletionTime::strict, {}});
  EXPECT_EQ(value(strict->rows[0], Measure::completion), 8);
}

TEST(Observations, CountsUntilTheStrictCompletionMayStandApart) {
  const std::string row =
      R"({"N_H":2,"N_P":1,"N_E":2,"T_app_ms":9,"T_strict_ms":12,"counts":{"init":38,"total":50})"
      R"(,"at_strict":{"total":70}})";
  EXPECT_EQ(value(read_text(row)->rows[0], Measure::messages), 50);
  const auto strict = read_text(row, {CompletionTime::strict, {}});
  EXPECT_EQ(value(strict->rows[0], Measure::messages), 70);
  EXPECT_FALSE(value(strict->rows[0], Measure::initial_data));
  const std::string wrong =
      R"({"N_H":2,"N_P":1,"N_E":2,"T_app_ms":9,"T_strict_ms":12,"at_strict":7})";
  EXPECT_NE(error_of(wrong, {CompletionTime::strict, {}}).find("at_strict"), std::string::npos);
}

TEST(Observations, SelectsByAnyField) {
  const std::string text = R"({"N_H":2,"N_P":1,"N_E":2,"T_app_ms":9,"lab":"a"})"
                           "\n\n"
                           R"({"N_H":2,"N_P":3,"N_E":2,"T_app_ms":9,"lab":"b"})";
  const auto read = read_text(text, {CompletionTime::app, {"lab=b", "N_P=3"}});
  ASSERT_TRUE(read);
  EXPECT_EQ(read->rows.size(), 1U);
  EXPECT_EQ(read->not_selected, 1U);
  EXPECT_EQ(error_of(text, {CompletionTime::app, {"lab=c"}}),
            "runs.jsonl: none of its 2 rows is selected by --select");
}

TEST(Observations, RefusesWithLineFieldAndExpectation) {
  const std::string good = R"({"N_H":2,"N_P":1,"N_E":2,"T_app_ms":9})";
  EXPECT_EQ(error_of(good + "\n" + R"({"N_H":2,"N_E":2,"T_app_ms":9})"),
            "runs.jsonl:2: N_P is missing; expected an integer from 1 to 4000");
  EXPECT_EQ(error_of(R"({"N_H":1,"N_P":1,"N_E":2,"T_app_ms":9})"),
            "runs.jsonl:1: N_H is 1; expected an integer from 2 to 4000");
  EXPECT_EQ(error_of(R"({"N_H":2,"N_P":1,"N_E":2})"),
            "runs.jsonl:1: T_app_ms is missing; expected the completion time in ms, or completed: "
            "false beside it");
  EXPECT_EQ(error_of("not json"),
            "runs.jsonl:1: not a JSON object; expected one measured run per line");
  EXPECT_EQ(error_of(""), "runs.jsonl: has no rows; expected one measured run per line");
}

TEST(Observations, RefusesImpossibleValues) {
  const std::string head = R"({"N_H":2,"N_P":1,"N_E":2,"T_app_ms":9,)";
  EXPECT_NE(error_of(head + R"("loss":1.5})").find("loss is 1.5"), std::string::npos);
  EXPECT_NE(error_of(head + R"("ep_done_ms":[5,4]})").find("ascending"), std::string::npos);
  EXPECT_NE(error_of(head + R"("counts":{"hb":-1}})").find("hb is -1"), std::string::npos);
  EXPECT_NE(error_of(head + R"("completed":"yes"})").find("true or false"), std::string::npos);
}

}  // namespace observation_test
}  // namespace stormproof::prediction
