// A rolling upgrade: which fleets it passes through, and which order of hosts is the best one.
#include "checker/experiments/diff/rolling.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "model/config/scenario_file.hpp"
#include "model/simulator.hpp"

namespace stormproof::diff {
namespace rolling_test {

namespace config = model::config;
const config::SpecPath specs{{STORMPROOF_SPECS_DIR}};

ReviewedPoint point(const std::string& deployment, const std::string& base = "fastdds-2.6.11",
                    const std::string& candidate = "fastdds-2.14.5") {
  ReviewedPoint point;
  point.name = "fleet";
  const auto with = [&](const std::string& dds) {
    auto scenario = config::parse_scenario("deployment: " + deployment + "\ndds: " + dds +
                                               "\nwireless: emulated-ap\ntime_limit: 60s\n",
                                           "f", {}, specs);
    EXPECT_TRUE(scenario) << to_string(scenario.error());
    return *scenario;
  };
  point.base = with(base);
  point.candidate = with(candidate);
  return point;
}

const std::string alike = "{hosts: 4, participants_per_host: 1, endpoints_per_participant: 2}";
const std::string two_kinds =
    "{participants: [{host: 0, publications: 9, subscriptions: 9}, {host: 1, publications: 1, "
    "subscriptions: 1}, {host: 2, publications: 1, subscriptions: 1}]}";

std::size_t count_upgraded(const model::Scenario& scenario) {
  return static_cast<std::size_t>(
      std::ranges::count_if(scenario.deployment.participants,
                            [](const model::Participant& p) { return p.dds.has_value(); }));
}

TEST(Rolling, OfHostsThatAreAlikeOneFleetForEachNumber) {
  const auto rolling = rolling_grid({"g", {point(alike)}, {}, 0});
  ASSERT_TRUE(rolling) << to_string(rolling.error());
  ASSERT_EQ(rolling->grid.points.size(), 4U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(count_upgraded(rolling->grid.points[k].candidate), k + 1);
    EXPECT_EQ(rolling->grid.points[k].candidate.dds, rolling->grid.points[k].base.dds);
  }
  EXPECT_EQ(rolling->grid.points[1].name, "fleet, 2 of 4 hosts upgraded");
  EXPECT_EQ(rolling->grid.points[3].candidate, point(alike).candidate);
}

TEST(Rolling, OfDifferentOnesAllThatAnOrderCanPassThrough) {
  const auto rolling = rolling_grid({"g", {point(two_kinds)}, {}, 0});
  ASSERT_TRUE(rolling);
  ASSERT_EQ(rolling->stages.size(), 1U);
  EXPECT_EQ(rolling->stages.front().kinds.size(), 2U);
  EXPECT_EQ(rolling->grid.points.size(), 5U);  // 2 · 3 − 1
  EXPECT_EQ(rolling->grid.points[1].name, "fleet, upgraded: 1 of 2 like host 1");
}

/// What each fleet costs, by its name.
CostComparison costs_of(const RollingGrid& rolling, const std::vector<double>& completion) {
  CostComparison costs;
  for (std::size_t k = 0; k < completion.size(); ++k) {
    Configuration& one = costs.configurations.emplace_back();
    one.name = rolling.grid.points[k].name;
    one.measures[static_cast<std::size_t>(Measure::completion)].after.median = completion[k];
    one.measures[static_cast<std::size_t>(Measure::messages)].after.median = 1;
  }
  return costs;
}

std::vector<std::uint32_t> hosts_of(const std::vector<RolloutStep>& order) {
  std::vector<std::uint32_t> hosts;
  for (const RolloutStep& step : order) hosts.push_back(step.host);
  return hosts;
}

TEST(Rolling, TheBestOrderAvoidsTheWorstFleet) {
  const auto rolling = rolling_grid({"g", {point(two_kinds)}, {}, 0});
  ASSERT_TRUE(rolling);
  // The fleets by upgraded hosts: {0}, {1}, {0, 1}, {1, 2}, all. That of host 0 alone is bad.
  ASSERT_EQ(rolling->grid.points[0].name, "fleet, upgraded: host 0");
  ASSERT_EQ(rolling->grid.points[2].name, "fleet, upgraded: host 0, 1 of 2 like host 1");
  const auto found = rollouts(*rolling, costs_of(*rolling, {9, 2, 3, 1, 1}));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(hosts_of(found.front().worst), (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(hosts_of(found.front().best), (std::vector<std::uint32_t>{1, 2, 0}));
  EXPECT_EQ(found.front().fleets, 5U);
  // A fleet that never completes is the worst, whatever the others cost.
  CostComparison costs = costs_of(*rolling, {9, 2, 3, 1, 1});
  costs.configurations[3].measures[static_cast<std::size_t>(Measure::completion)].after.median = {};
  EXPECT_EQ(hosts_of(rollouts(*rolling, costs).front().best),
            (std::vector<std::uint32_t>{1, 0, 2}));
  costs.configurations.pop_back();
  EXPECT_TRUE(rollouts(*rolling, costs).empty());
}

TEST(Rolling, WhatCannotBeMixedIsRefused) {
  const auto other =
      rolling_grid({"g", {point(alike, "fastdds-2.6.11", "cyclonedds-0.10")}, {}, 0});
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().message.find("cannot run beside each other"), std::string::npos);
  ReviewedPoint mixed = point(alike);
  mixed.base.deployment.participants[0].dds = mixed.candidate.dds;
  EXPECT_FALSE(rolling_grid({"g", {mixed}, {}, 0}));
  std::string many;
  for (int k = 0; k < 9; ++k) {
    many += (k == 0 ? "" : ", ") + std::string{"{host: "} + std::to_string(k) +
            ", publications: " + std::to_string(k) + ", subscriptions: 0}";
  }
  const auto large = rolling_grid({"g", {point("{participants: [" + many + "]}")}, {}, 0});
  ASSERT_FALSE(large);
  EXPECT_NE(large.error().message.find("more than 256 fleets"), std::string::npos);
}

TEST(Rolling, IsComparedWithTheFleetBefore) {
  const auto profile = [](const char* name) { return *config::trace_dds_profile(name, {}, specs); };
  DiffRequest request;
  request.base = profile("fastdds-2.6.11");
  request.candidate = profile("fastdds-3.6");
  request.policy = *read_policy("default", specs);
  request.grid = std::string{STORMPROOF_SPECS_DIR} + "/scenarios/three-hosts.yaml";
  request.check_verdicts = false;
  request.tell_apart = false;
  request.rolling = true;
  const auto report = diff(request, specs);
  ASSERT_TRUE(report) << to_string(report.error());
  ASSERT_EQ(report->costs.configurations.size(), 3U);
  ASSERT_EQ(report->rollouts.size(), 1U);
  EXPECT_EQ(hosts_of(report->rollouts.front().best), (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_FALSE(report->blame);
  // The fleet in between is none of the two ends.
  const Configuration& between = report->costs.configurations[1];
  EXPECT_NE(between[Measure::completion].after.median, between[Measure::completion].before.median);
  EXPECT_NE(between[Measure::completion].after.median,
            report->costs.configurations[2][Measure::completion].after.median);
}

}  // namespace rolling_test
}  // namespace stormproof::diff
