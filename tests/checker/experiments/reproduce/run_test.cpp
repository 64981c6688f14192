// The runs of the plan are those of the scenarios that anyone can simulate alone.
#include "checker/experiments/reproduce/run.hpp"

#include <gtest/gtest.h>

#include "model/config/scenario_file.hpp"
#include "model/simulator.hpp"
#include "tests/checker/experiments/reproduce/examples.hpp"

namespace stormproof::reproduce {
namespace run_test {

using model::HeartbeatPolicy;
using model::config::read_scenario;
using model::config::SpecPath;

/// The shipped scenario with these changes, simulated on its own.
model::RunResult direct(const std::string& name, const std::vector<std::string>& changes) {
  const auto scenario = read_scenario(name, changes, SpecPath::standard());
  EXPECT_TRUE(scenario) << (scenario ? "" : to_string(scenario.error()));
  return scenario ? simulate(*scenario) : model::RunResult{};
}

/// Simulator runs of all cases.
std::size_t runs_of(const Plan& plan) {
  std::size_t count = 0;
  for (const Case& one : plan.cases) count += plan.variants[one.variant].runs;
  return count;
}

class RunTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const Published published = figures_with_grid("[5]", "[20]");
    results_ = new Results{run(plan_of(published, {{}, 2}))};
  }
  static void TearDownTestSuite() { delete results_; }

  static void expect_same(std::size_t variant, Network network, HeartbeatPolicy policy,
                          model::ServiceOrder order, std::size_t k,
                          const model::RunResult& expected) {
    const Outcome* outcome = results_->find({variant, network, policy, order, {5, 20}});
    ASSERT_NE(outcome, nullptr);
    ASSERT_GT(outcome->runs.size(), k);
    EXPECT_EQ(outcome->runs[k].completion, expected.discovery_time);
    EXPECT_EQ(outcome->runs[k].counts, expected.counts);
  }

  static Results* results_;
};
Results* RunTest::results_ = nullptr;

TEST_F(RunTest, RunsEveryCase) {
  EXPECT_TRUE(results_->complete);
  EXPECT_EQ(results_->outcomes.size(), results_->plan.cases.size());
  EXPECT_EQ(results_->plan.cases.size(), 3U * 6 + 2 * 4);
  EXPECT_EQ(runs_of(results_->plan), 3U * 6 + 2 * 4 * 2);
  EXPECT_GT(results_->evaluation_cpu_s, 0);
  EXPECT_GT(results_->total_cpu_s, results_->evaluation_cpu_s);
}

TEST_F(RunTest, ThePaperOnWifiIsTheShippedScenario) {
  expect_same(0, Network::wireless, HeartbeatPolicy::periodic, orders[0], 0,
              direct("wifi-5x20", {}));
  expect_same(0, Network::wired, HeartbeatPolicy::periodic, orders[0], 0, direct("wired-5x20", {}));
}

TEST_F(RunTest, PoliciesAndOrdersAreThoseOfTheProfiles) {
  expect_same(0, Network::wireless, HeartbeatPolicy::adaptive, orders[0], 0,
              direct("wifi-5x20", {"dds.sedp.heartbeat_policy=adaptive"}));
  expect_same(0, Network::wireless, HeartbeatPolicy::periodic, orders[1], 0,
              direct("wifi-5x20", {"wireless.order=fifo_downlink"}));
  expect_same(0, Network::wireless, HeartbeatPolicy::periodic, orders[2], 0,
              direct("wifi-5x20", {"wireless.order=datagram_uplink"}));
}

TEST_F(RunTest, VariantsAreTheProfilesOfTheirNames) {
  expect_same(1, Network::wireless, HeartbeatPolicy::periodic, orders[0], 0,
              direct("wifi-5x20", {"dds=fastdds-2.6.11-relations"}));
  expect_same(2, Network::wired, HeartbeatPolicy::periodic, orders[0], 0,
              direct("wired-5x20", {"dds=fastdds-2.6.11"}));
}

TEST_F(RunTest, DrawnStartTimesAreThoseOfTheLiveScenario) {
  expect_same(3, Network::wired, HeartbeatPolicy::periodic, orders[0], 1,
              direct("live-5x20", {"wireless=wired", "deployment.schedule.seed=1"}));
}

TEST_F(RunTest, ALoopbackRunHasAsManyPeers) {
  expect_same(0, Network::loopback, HeartbeatPolicy::periodic, orders[0], 0,
              direct("wired-5x20", {"deployment.hosts=6", "deployment.participants_per_host=1"}));
}

TEST(Plan, HasTheNinetyConfigurations) {
  const Plan plan = plan_of(shipped_figures());
  EXPECT_EQ(plan.configurations.size(), 90U);
  EXPECT_EQ(std::count_if(plan.configurations.begin(), plan.configurations.end(),
                          [&](const Configuration& one) { return plan.high_load(one); }),
            18);
  EXPECT_EQ(plan.variants.size(), variant_ids().size());
}

TEST(Plan, TheTrueChannelIsThatOfFastDdsAlone) {
  const Plan plan = plan_of(figures_with_grid("[1]", "[2]"));
  for (const Case& one : plan.cases) {
    const bool is_true = plan.variants[one.variant].id == "fastdds-2.6.11-true-channel";
    const model::WirelessProfile w = plan.scenario(one, 3).wireless;
    const bool is_wireless = one.network == Network::wireless;
    EXPECT_EQ(w.sender == model::Sender::stalls, is_true && is_wireless);
    if (is_true && is_wireless) {
      EXPECT_EQ(w.order, model::ServiceOrder::fifo);
    }
  }
}

TEST(Interruption, KeepsWhatIsFinished) {
  const Plan plan = plan_of(figures_with_grid("[1]", "[2, 4]"), {{"paper"}, 1});
  RunLimits limits;
  limits.threads = 1;
  limits.on_progress = [](std::size_t finished, std::size_t) { return finished < 3; };
  const Results results = run(plan, limits);
  EXPECT_FALSE(results.complete);
  EXPECT_EQ(results.outcomes.size(), 3U);
  EXPECT_LT(results.outcomes.size(), plan.cases.size());
}

/// The first draws are the same, whether or not more follow. The configuration with figures of its
/// own has all.
TEST(RunTestDraws, EndWhereFiguresAreDecided) {
  const Published published = figures_with_grid("[1, 5]", "[2, 20]");
  Plan plan = plan_of(published, {{"fastdds-2.6.11-true-channel"}, 4});
  std::erase_if(plan.cases, [](const Case& one) {
    return one.configuration.participants_per_host == 5 && one.configuration != counted;
  });
  RunLimits limits;
  limits.published = &published;
  const Results few = run(plan, limits);
  const Results all = run(plan);
  ASSERT_TRUE(few.complete);
  EXPECT_LT(few.runs, all.runs);
  EXPECT_EQ(all.runs, runs_of(plan));
  const Outcome* counted_ones = few.find(0, Network::wireless, counted);
  ASSERT_NE(counted_ones, nullptr);
  EXPECT_EQ(counted_ones->runs.size(), 4U);
  for (const auto& [which, outcome] : few.outcomes) {
    const Outcome* whole = all.find(which);
    ASSERT_NE(whole, nullptr);
    ASSERT_LE(outcome.runs.size(), whole->runs.size());
    for (std::size_t k = 0; k < outcome.runs.size(); ++k) {
      EXPECT_EQ(outcome.runs[k].completion, whole->runs[k].completion);
    }
  }
}

}  // namespace run_test
}  // namespace stormproof::reproduce
