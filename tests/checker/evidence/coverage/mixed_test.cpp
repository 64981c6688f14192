// Rows that say what each process runs: their words become profiles, and fleets of mixed versions
// of Fast DDS are predicted as near as was set as a goal.
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "checker/evidence/coverage/study.hpp"
#include "model/config/scenario_file.hpp"

namespace stormproof::prediction {
namespace mixed_test {

const std::string specs = STORMPROOF_SPECS_DIR;

model::config::Result<Observations> rows_of(const std::string& text) {
  std::istringstream input{text};
  return read_observations(input, "rows", {});
}
std::string row(const std::string& profiles) {
  return R"({"N_H": 2, "N_P": 1, "N_E": 2, "T_app_ms": 100, "profiles": )" + profiles + "}\n";
}
ScenarioOptions options(const std::string& dds, std::vector<std::string> words = {}) {
  return {dds, "emulated-ap", {}, ChannelSource::profile, std::move(words)};
}

TEST(MixedRows, EachProcessHasItsProfile) {
  const auto rows = rows_of(row(R"({"0/0": "fastdds-2.14.5", "1/0": "Fast DDS 3.6.2"})"));
  ASSERT_TRUE(rows) << to_string(rows.error());
  const auto found = configurations(rows->rows);
  ASSERT_EQ(found.size(), 1U);
  const auto scenario = scenario_of(found.front(), options("fastdds-2.6.11"));
  ASSERT_TRUE(scenario) << to_string(scenario.error());
  const auto preset = [](const char* name) {
    return *model::config::read_dds_profile(name, {}, {{specs}});
  };
  EXPECT_EQ(dds_of(*scenario, 0), preset("fastdds-2.14.5"));
  EXPECT_EQ(dds_of(*scenario, 1), preset("fastdds-3.6"));
}

TEST(MixedRows, WordsAreWhatIsSaidOfThem) {
  const auto rows = rows_of(row(R"({"0/0": "new", "1/0": "old"})"));
  ASSERT_TRUE(rows);
  const Configuration one = configurations(rows->rows).front();
  const auto said = scenario_of(
      one, options("fastdds-2.6.11",
                   {"new=fastdds-3.6", "old={base: fastdds-2.6.11, spdp: {period: 9s}}"}));
  ASSERT_TRUE(said) << to_string(said.error());
  EXPECT_EQ(dds_of(*said, 1).spdp.period, model::Nanoseconds{9'000'000'000});
  const auto unsaid = scenario_of(one, options("fastdds-2.6.11", {"new=fastdds-3.6"}));
  ASSERT_FALSE(unsaid);
  EXPECT_NE(to_string(unsaid.error()).find("--runs WORD=PROFILE"), std::string::npos);
  const auto other = scenario_of(one, options("cyclonedds-0.10", {"new=fastdds-3.6", "old=x"}));
  ASSERT_FALSE(other);
  EXPECT_NE(to_string(other.error()).find("cannot run beside --dds"), std::string::npos);
}

TEST(MixedRows, EveryProcessIsNamedOrNone) {
  const auto rows = rows_of(row(R"({"0/0": "fastdds-2.14.5"})"));
  ASSERT_FALSE(rows);
  EXPECT_NE(rows.error().message.find("what each process runs"), std::string::npos);
}

TEST(MixedRows, OfDifferentProfilesAreNotPooled) {
  const auto rows =
      rows_of(row(R"({"0/0": "a", "1/0": "b"})") + row(R"({"0/0": "b", "1/0": "a"})"));
  ASSERT_TRUE(rows);
  EXPECT_EQ(configurations(rows->rows).size(), 2U);
}

TEST(MixedRows, FleetsOfMixedVersionsArePredicted) {
  std::ifstream input{specs + "/observations/fastdds-mixed.jsonl"};
  const auto rows = read_observations(input, "fastdds-mixed", {});
  ASSERT_TRUE(rows) << to_string(rows.error());
  StudyRequest request;
  request.dds = {"fastdds-2.6.11"};
  request.wireless = "emulated-ap";
  request.scopes = {"all"};
  const std::string doubling = "Fast DDS 2.9.1, doubling";
  request.words = {doubling + "=fastdds-2.6.11",
                   doubling + ", sendBufferSize 4000000=fastdds-2.6.11-sndbuf4M",
                   doubling +
                       ", delays of 2.14.5={base: fastdds-2.6.11, sedp: {nack_response_delay: "
                       "100ms, nack_suppression_duration: 10ms, heartbeat_response_delay: 10ms}}"};
  const auto found = study(rows->rows, {}, request);
  ASSERT_TRUE(found) << to_string(found.error());
  for (const FitRow& row : found->profiles.front().rows) {
    if (row.measure == Measure::completion) {
      EXPECT_LE(row.fit.median_abs_ln_ratio.value(), 0.12);
    }
    if (row.measure == Measure::messages) {
      EXPECT_LE(row.fit.median_abs_ln_ratio.value(), 0.2);
    }
  }
  EXPECT_EQ(found->profiles.front().configurations.size(), 23U);
}

}  // namespace mixed_test
}  // namespace stormproof::prediction
