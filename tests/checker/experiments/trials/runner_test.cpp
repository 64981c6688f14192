// Order, progress and interruption of jobs, with one thread and with several.
#include "checker/experiments/trials/runner.hpp"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <set>
#include <thread>

#include <gtest/gtest.h>

#include "model/deployment.hpp"

namespace stormproof::trials {
namespace runner_test {

using Results = std::vector<std::optional<std::size_t>>;

std::optional<std::size_t> square(std::size_t k) { return k * k; }

class TrialRunner : public testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Threads, TrialRunner, testing::Values(1, 2, 7));

TEST_P(TrialRunner, ResultsAreInTheOrderOfTheJobs) {
  Runner runner{GetParam()};
  const Results results = runner.run(100, [](std::size_t k) {
    // The first jobs take longest.
    if (k < 5) std::this_thread::sleep_for(std::chrono::milliseconds{5});
    return square(k);
  });
  ASSERT_EQ(results.size(), 100U);
  for (std::size_t k = 0; k < results.size(); ++k) EXPECT_EQ(results[k], k * k);
  EXPECT_EQ(runner.finished(), 100U);
  EXPECT_FALSE(runner.stopped());
}

TEST_P(TrialRunner, EveryJobRunsOnce) {
  std::vector<std::atomic<int>> times(200);
  Runner runner{GetParam()};
  EXPECT_TRUE(runner.each(times.size(), [&](std::size_t k) { return ++times[k] > 0; }));
  for (const auto& count : times) EXPECT_EQ(count, 1);
}

TEST_P(TrialRunner, ProgressNeverGoesBackAndEndsWithAll) {
  std::vector<std::size_t> told;
  std::atomic<int> inside = 0;
  Runner runner{GetParam(), [&](std::size_t finished, std::size_t all) {
                  EXPECT_EQ(++inside, 1);  // one thread at a time
                  EXPECT_EQ(all, 50U);
                  told.push_back(finished);
                  --inside;
                  return true;
                }};
  const Results results = runner.run(50, [&](std::size_t k) {
    EXPECT_TRUE(runner.goes_on());
    return square(k);
  });
  EXPECT_TRUE(std::ranges::is_sorted(told));
  EXPECT_EQ(told.back(), 50U);
  const std::set<std::size_t> distinct{told.begin(), told.end()};
  for (std::size_t k = 1; k <= 50; ++k) EXPECT_TRUE(distinct.contains(k)) << k;
}

TEST_P(TrialRunner, InterruptionKeepsWhatIsFinished) {
  Runner runner{GetParam(), [](std::size_t finished, std::size_t) { return finished < 10; }};
  const Results results = runner.run(1'000, square);
  EXPECT_TRUE(runner.stopped());
  EXPECT_FALSE(runner.goes_on());
  EXPECT_GE(runner.finished(), 10U);
  EXPECT_LT(runner.finished(), 10U + GetParam());
  EXPECT_EQ(present(results).size(), runner.finished());
  for (std::size_t k = 0; k < results.size(); ++k) {
    if (results[k]) {
      EXPECT_EQ(results[k], k * k);
    }
  }
  // Nothing starts any more.
  EXPECT_FALSE(runner.each(3, [](std::size_t) {
    ADD_FAILURE() << "started";
    return true;
  }));
}

TEST_P(TrialRunner, JobThatFailsStartsNoFurtherOnesAndStopsNobodyElse) {
  Runner runner{GetParam()};
  std::atomic<std::size_t> started = 0;
  EXPECT_FALSE(runner.each(1'000, [&](std::size_t k) {
    ++started;
    return k != 5;
  }));
  EXPECT_LT(started, 1'000U);
  EXPECT_FALSE(runner.stopped());
  EXPECT_TRUE(runner.each(3, [](std::size_t) { return true; }));
}

TEST_P(TrialRunner, SeveralPhasesCountTogether) {
  std::size_t last = 0;
  std::size_t last_all = 0;
  Runner runner{GetParam(),
                [&](std::size_t finished, std::size_t all) {
                  last = finished;
                  last_all = all;
                  return true;
                },
                7};
  (void)runner.run(10, square);
  EXPECT_EQ(last, 17U);
  EXPECT_EQ(last_all, 17U);
  (void)runner.run(4, square);
  EXPECT_EQ(last, 21U);
  EXPECT_EQ(last_all, 21U);
  EXPECT_TRUE(runner.each(0, [](std::size_t) { return false; }));
}

TEST_P(TrialRunner, SimulationsEndWhenProgressSaysSo) {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(2, 1, 2);
  std::atomic<bool> wanted = true;
  Runner runner{GetParam(), [&](std::size_t, std::size_t) { return wanted.load(); }};
  const auto first = runner.run(4, [&](std::size_t) { return runner.simulate(scenario); });
  ASSERT_EQ(present(first).size(), 4U);
  EXPECT_TRUE(first.front()->completed());
  wanted = false;
  const auto second = runner.run(100, [&](std::size_t) { return runner.simulate(scenario); });
  EXPECT_LE(present(second).size(), GetParam());
  EXPECT_TRUE(runner.stopped());
}

TEST(TrialResults, KeepsResultsInOrderWithoutTheAbsentOnes) {
  EXPECT_EQ(present(Results{std::nullopt, 4, std::nullopt, 1}), (std::vector<std::size_t>{4, 1}));
}

}  // namespace runner_test
}  // namespace stormproof::trials
