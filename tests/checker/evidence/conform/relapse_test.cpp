// A capture in which leases end: until somebody forgets somebody it is held against the profile,
// and what comes then is not called a violation.
#include <algorithm>

#include <gtest/gtest.h>

#include "checker/evidence/capture/relapses.hpp"
#include "checker/evidence/capture/write/simulated_capture.hpp"
#include "checker/evidence/conform/conform.hpp"
#include "model/config/scenario_file.hpp"

namespace stormproof::conform {
namespace relapse_test {

model::Scenario scenario_with(const std::string& dds, const std::string& until) {
  auto scenario = model::config::parse_scenario(
      "{deployment: {hosts: 2, participants_per_host: 1, endpoints_per_participant: 4, life: "
      "{outages: [{from: 0, to: 1, start: 6s, end: " +
          until + "}, {from: 1, to: 0, start: 6s, end: " + until + "}]}}, dds: " + dds +
          ", wireless: wifi-80211n-paper, time_limit: 60s, run_until: time_limit}",
      "scenario", {}, model::config::SpecPath::standard());
  EXPECT_TRUE(scenario) << to_string(scenario.error());
  return *scenario;
}

capture::Conversation capture_of(const model::Scenario& scenario) {
  const capture::SimulatedCapture simulated = capture::simulated_capture(scenario);
  const std::vector<capture::MemoryCapture> files{
      {"run", simulated.pcap, simulated.pcap.size() + 1}};
  auto conversation = capture::read_conversation(files);
  EXPECT_TRUE(conversation) << to_string(conversation.error());
  return *std::move(conversation);
}

bool ends_early(const Conformance& result) {
  return std::ranges::any_of(result.assumptions, [](const std::string& one) {
    return one.find("discovery has no rule for leases") != std::string::npos;
  });
}

class Relapses : public ::testing::TestWithParam<const char*> {};

TEST_P(Relapses, EndWhatIsHeldAgainstTheProfile) {
  const model::Scenario scenario = scenario_with(GetParam(), "46s");
  const capture::Conversation conversation = capture_of(scenario);
  const auto relapses = capture::relapses(conversation);
  EXPECT_EQ(relapses.size(), 2U) << "both forgot the other";
  const auto result = conform({conversation, INT64_MAX, scenario.dds});
  ASSERT_TRUE(result) << to_string(result.error());
  EXPECT_EQ(result->verdict, Verdict::conforms);
  EXPECT_TRUE(ends_early(*result));
  EXPECT_GT(result->explained, 20U);
}

TEST_P(Relapses, AreNoneWhereLeasesHold) {
  const model::Scenario scenario = scenario_with(GetParam(), "7s");
  const capture::Conversation conversation = capture_of(scenario);
  EXPECT_TRUE(capture::relapses(conversation).empty());
  const auto result = conform({conversation, INT64_MAX, scenario.dds});
  ASSERT_TRUE(result) << to_string(result.error());
  EXPECT_EQ(result->verdict, Verdict::conforms);
  EXPECT_FALSE(ends_early(*result));
}

INSTANTIATE_TEST_SUITE_P(All, Relapses,
                         ::testing::Values("fastdds-2.6.11", "fastdds-2.14.5", "cyclonedds-0.10"),
                         [](const auto& one) {
                           std::string name = one.param;
                           std::erase_if(name, [](char c) { return !std::isalnum(c); });
                           return name;
                         });

}  // namespace relapse_test
}  // namespace stormproof::conform
