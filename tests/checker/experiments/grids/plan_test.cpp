// The jobs of a grid are the scenarios that the same overrides give on the command line, and their
// digests tell different runs apart and equal ones not.
#include "checker/experiments/grids/plan.hpp"

#include <set>

#include <gtest/gtest.h>

#include "model/config/scenario_file.hpp"

namespace stormproof::grids {
namespace plan_test {

using model::config::SpecPath;

model::config::Result<Plan> plan_of(const std::string& text) {
  auto grid = parse_grid(text, "g.yaml", SpecPath::standard());
  if (!grid) return grid.error();
  return make_plan(*std::move(grid), SpecPath::standard());
}

std::string error(const std::string& text) {
  const auto plan = plan_of(text);
  return plan ? "no error" : to_string(plan.error());
}

model::Scenario scenario(const std::string& name, const std::vector<std::string>& overrides) {
  auto read = model::config::read_scenario(name, overrides, SpecPath::standard());
  EXPECT_TRUE(read) << to_string(read.error());
  return *std::move(read);
}

Digest digest(const std::string& text) {
  const auto plan = plan_of(text);
  EXPECT_TRUE(plan) << to_string(plan.error());
  EXPECT_EQ(plan->size(), 1U);
  return plan->digest(0);
}

TEST(Plan, JobsAreTheScenariosOfTheSameOverrides) {
  const std::string name = "wifi-5x20-fastdds";
  const auto plan = plan_of(
      "base: " + name +
      "\ngrid:\n"
      "  dds.sedp.heartbeat_period: [500ms, 2s]\n"
      "  dds: [paper, fastdds-2.6.11, {base: fastdds-2.14.5, sedp: {heartbeat_policy: adaptive}}]\n"
      "  wireless.base: [wifi-80211n, ad-hoc]\n"
      "  wireless.stages.0.rate_multicast: [6Mbps, 12Mbps]\n"
      "  deployment.participants_per_host: [1, 3]\n"
      "  deployment.schedule.seed: [0, 5]\n"
      "  time_limit: [1s, 2s]\n");
  ASSERT_TRUE(plan) << to_string(plan.error());
  ASSERT_EQ(plan->size(), 192U);
  std::set<Digest> digests;
  for (std::size_t job = 0; job < plan->size(); ++job) {
    ASSERT_FALSE(plan->error(job)) << to_string(*plan->error(job));
    std::vector<std::string> overrides;
    const std::vector<std::string> keys = plan->keys();
    const std::vector<std::string> values = plan->values(job);
    for (std::size_t k = 0; k < keys.size(); ++k) overrides.push_back(keys[k] + "=" + values[k]);
    EXPECT_EQ(plan->scenario(job), scenario(name, overrides)) << "job " << job;
    digests.insert(plan->digest(job));
  }
  EXPECT_EQ(digests.size(), plan->size());
}

TEST(Plan, SamplesDrawTheirSchedules) {
  const auto plan = plan_of("base: live-5x20\nsamples: 3\nseed: 10\ngrid: {dds: [paper]}\n");
  ASSERT_TRUE(plan) << to_string(plan.error());
  ASSERT_EQ(plan->size(), 3U);
  for (std::size_t job = 0; job < 3; ++job) {
    const std::string seed = std::to_string(10 + job);
    EXPECT_EQ(plan->scenario(job),
              scenario("live-5x20", {"dds=paper", "deployment.schedule.seed=" + seed}));
    EXPECT_EQ(plan->values(job), (std::vector<std::string>{"paper", seed}));
  }
  EXPECT_NE(plan->digest(0), plan->digest(1));
  EXPECT_EQ(plan->digest(1),
            digest("base: live-5x20\ngrid: {dds: [paper], deployment.schedule.seed: [11]}\n"));
}

TEST(Plan, ShardsHaveEachJobOfTheGridOnce) {
  const std::string text =
      "base: live-5x20\nscenarios: [{dds: paper}, {deployment.hosts: 1}]\nsamples: 5\n"
      "grid: {deployment.participants_per_host: [1, 2, 3]}\n";
  const auto whole = plan_of(text);
  ASSERT_TRUE(whole) << to_string(whole.error());
  ASSERT_EQ(whole->size(), 30U);
  for (const std::size_t count : {1U, 4U, 7U, 40U}) {
    std::size_t jobs = 0;
    for (std::size_t number = 0; number < count; ++number) {
      auto grid = parse_grid(text, "g.yaml", SpecPath::standard());
      ASSERT_TRUE(grid);
      const Shard shard{number, count};
      // Some shards have nothing but jobs that cannot run.
      const auto plan = make_plan(*std::move(grid), SpecPath::standard(), shard);
      ASSERT_TRUE(plan) << to_string(plan.error());
      EXPECT_EQ(plan->size(), shard.size(whole->size()));
      for (std::size_t k = 0; k < plan->size(); ++k) {
        const std::size_t job = number + k * count;
        ++jobs;
        EXPECT_EQ(plan->digest(k), whole->digest(job)) << job;
        EXPECT_EQ(plan->values(k), whole->values(job));
        EXPECT_EQ(plan->values_json(k), whole->values_json(job));
        ASSERT_EQ(plan->error(k).has_value(), whole->error(job).has_value());
        if (!plan->error(k)) {
          EXPECT_EQ(plan->scenario(k), whole->scenario(job));
        }
      }
    }
    EXPECT_EQ(jobs, whole->size());
  }
}

TEST(Plan, AShardMayBelongToAGridThatIsTooLargeForOne) {
  const std::string text =
      "base: live-5x20\nsamples: 1000000\ngrid: {dds.sedp.heartbeat_period: {from: 1ms, to: 1s, "
      "step: 1ms}}\n";
  EXPECT_EQ(error(text).substr(0, 34), "g.yaml:1:1: more than 1000000 jobs");
  auto grid = parse_grid(text, "g.yaml", SpecPath::standard());
  ASSERT_TRUE(grid) << to_string(grid.error());
  const auto plan = make_plan(*std::move(grid), SpecPath::standard(), {9'999'999, 10'000'000});
  ASSERT_TRUE(plan) << to_string(plan.error());
  ASSERT_EQ(plan->size(), 100U);
  EXPECT_EQ(plan->values(99), (std::vector<std::string>{"1s", "999999"}));
}

TEST(Plan, DigestsLookAtInputsNotAtTheirSpelling) {
  const Digest own = digest("base: smallest\n");
  EXPECT_EQ(own, digest("scenarios: [smallest]\n"));
  EXPECT_EQ(own, digest("base: smallest\ngrid: {time_limit: [200000ms]}\n"));
  EXPECT_EQ(own, digest("base: smallest\ngrid: {dds.sedp.heartbeat_period: [1000ms]}\n"));
  EXPECT_EQ(own, digest("base: smallest\ngrid: {dds: [{base: paper}]}\n"));
  EXPECT_EQ(own, digest("base: {deployment: {participants: ["
                        "{host: 0, publications: 1, subscriptions: 1},"
                        "{host: 1, publications: 1, subscriptions: 1}]},"
                        "dds: paper, wireless: wifi-80211n, time_limit: 200s}\n"));
  EXPECT_EQ(own, digest("base: smallest\ngrid: {limits.completion: [1s]}\n"));
}

TEST(Plan, DigestsTellInputsApart) {
  std::set<Digest> digests{digest("base: smallest\n")};
  const std::string changes[] = {"time_limit: [100s]",
                                 "run_until: [time_limit]",
                                 "deployment.endpoints_per_participant: [3]",
                                 "deployment.loopback_delay: [1ms]",
                                 "deployment.hosts: [3]",
                                 "deployment.schedule: [{start: [1ns, 1ns]}]",
                                 "dds.sedp.heartbeat_period: [1001ms]",
                                 "dds.sedp.piggyback: [linear]",
                                 "dds.sedp.adaptive.epsilon: [1/10]",
                                 "dds.descriptors.default_bytes: [[452, 533]]",
                                 "dds: [fastdds-2.6.11]",
                                 "wireless.order: [fifo]",
                                 "wireless.rate_unicast: [144.5Mbps]",
                                 "wireless.source_queue_bytes: [unlimited]",
                                 "wireless.lost_packets: [[3]]",
                                 "wireless.stages.1.channel: [down]",
                                 "wireless: [wired]"};
  for (const std::string& change : changes) {
    EXPECT_TRUE(digests.insert(digest("base: smallest\ngrid: {" + change + "}\n")).second)
        << change;
  }
}

TEST(Plan, EqualJobsAreRunOnce) {
  const auto plan = plan_of("base: smallest\ngrid: {time_limit: [200s, 100s, 200000ms]}\n");
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->first_alike(0), 0U);
  EXPECT_EQ(plan->first_alike(1), 1U);
  EXPECT_EQ(plan->first_alike(2), 0U);
  EXPECT_EQ(plan->values_json(2), "{\"time_limit\":\"200000ms\"}");
}

TEST(Plan, AWrongCombinationIsAJobWithAnError) {
  const auto plan = plan_of(
      "base: smallest\ngrid:\n  deployment.hosts: [1, 2]\n"
      "  deployment.participants_per_host: [2000, 2]\n");
  ASSERT_TRUE(plan) << to_string(plan.error());
  ASSERT_TRUE(plan->error(0));
  EXPECT_NE(plan->error(0)->message.find("at least two hosts"), std::string::npos);
  EXPECT_TRUE(plan->error(1));
  EXPECT_NE(plan->digest(0), plan->digest(1));
  EXPECT_FALSE(plan->error(2));
  EXPECT_FALSE(plan->error(3));
}

TEST(Plan, WhatIsWrongWhereverItOccursIsRefused) {
  EXPECT_EQ(error("base: smallest\ngrid: {dds.sedp.hartbeat_period: [1s]}\n"),
            "g.yaml:2:35: unknown key 'hartbeat_period' in dds.sedp; did you mean "
            "'heartbeat_period'?");
  EXPECT_EQ(error("base: smallest\ngrid: {dsd: [paper]}\n"),
            "g.yaml:2:14: unknown key 'dsd'; did you mean 'dds'?");
  EXPECT_EQ(error("base: smallest\ngrid: {dds: [paper, papr]}\n").substr(0, 32),
            "g.yaml:2:21: no dds file named '");
  EXPECT_EQ(error("base: smallest\ngrid:\n  wireless.order: [fifo,\n    fofo]\n  a.b: [1]\n")
                .substr(0, 12),
            "g.yaml:5:9: ");
  EXPECT_EQ(error("base: smallest\ngrid:\n  wireless.order: [fifo,\n    fofo]\n").substr(0, 13),
            "g.yaml:4:5: w");
  EXPECT_EQ(error("base: smallest\nscenarios: [{}, {wireless.order: fofo}]\n").substr(0, 12),
            "g.yaml:2:34:");
  EXPECT_EQ(error("base: smallest\nsamples: 2\n").substr(0, 16), "g.yaml: samples:");
  EXPECT_EQ(error("base: {dds: paper}\n").substr(0, 12), "g.yaml:1:7: ");
  EXPECT_EQ(error("base: smallest\ngrid: {dds.implementation: [fastdds]}\n").substr(0, 27),
            "g.yaml:2:29: implementation");
}

}  // namespace plan_test
}  // namespace stormproof::grids
