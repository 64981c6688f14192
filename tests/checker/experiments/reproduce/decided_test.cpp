// No more draws than decide the figures: what is decided early is what all draws decide.
#include "checker/experiments/reproduce/decided.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/checker/experiments/reproduce/examples.hpp"

namespace stormproof::reproduce {
namespace decided_test {

TEST(Looks, TakeTwoThreeAndAll) {
  EXPECT_EQ(looks(5), (std::vector<std::size_t>{2, 3, 5}));
  EXPECT_EQ(looks(2), (std::vector<std::size_t>{2}));
  EXPECT_EQ(looks(1), (std::vector<std::size_t>{1}));
  EXPECT_DOUBLE_EQ(confidence_of_look(5), 1 - 0.05 / 3);
  EXPECT_DOUBLE_EQ(confidence_of_look(2), 0.95);
}

const Plan& plan() {
  static const Plan all = plan_of(shipped_figures(), {{"fastdds-2.6.11-staggered"}, 5});
  return all;
}

/// Outcomes of `draws` draws at N_P 4 whose true means are `factor` times the published ones, with
/// heavy tails; nothing is simulated.
Results drawn(const Published& published, double factor, std::size_t draws, unsigned seed) {
  Results results;
  results.plan = plan();
  constexpr double sigma = 0.4;
  const double mean = std::exp(sigma * sigma / 2);
  const auto value = [&](const char* quantity, const char* column) {
    return published.values(std::string{"observed_means.np4."} + quantity + "." + column).front();
  };
  for (const Configuration& one : results.plan.configurations) {
    if (one.participants_per_host != 4) continue;
    const double share = one.endpoints_per_participant / 16.0;  // 1 on average
    for (std::size_t k = 0; k < draws; ++k) {  // the first ones are the same, however many follow
      std::mt19937_64 random{1'000 * seed + 10 * one.endpoints_per_participant + k};
      std::normal_distribution<double> normal;
      const double chance = factor * share * std::exp(sigma * normal(random)) / mean;
      for (const auto policy :
           {model::HeartbeatPolicy::periodic, model::HeartbeatPolicy::adaptive}) {
        const bool is_baseline = policy == model::HeartbeatPolicy::periodic;
        const char* column = is_baseline ? "baseline" : "adaptive";
        model::Counts counts;
        counts.heartbeat =
            static_cast<std::uint64_t>(std::llround(chance * value("messages", column)));
        results.outcomes[{0, Network::wireless, policy, orders[0], one}].runs.push_back(
            finished_run(chance * value("completion_s", column), counts));
      }
    }
  }
  return results;
}

TEST(Decided, WhatIsFarFromThePublishedMeansNeedsTwoDraws) {
  const Published published = shipped_figures();
  EXPECT_TRUE(means_are_decided(published, drawn(published, 5, 2, 1), 0, 4, 0.98));
  EXPECT_TRUE(means_are_decided(published, drawn(published, 0.1, 2, 1), 0, 4, 0.98));
}

TEST(Decided, WhatIsNearTheEdgeNeedsMore) {
  const Published published = shipped_figures();
  EXPECT_FALSE(means_are_decided(published, drawn(published, 1.1, 2, 1), 0, 4, 0.98));
  EXPECT_FALSE(means_are_decided(published, drawn(published, 0.9, 5, 1), 0, 4, 0.98));
}

TEST(Decided, AMeanThatDoesNotExistNeedsNoMore) {
  const Published published = shipped_figures();
  Results results = drawn(published, 1.1, 2, 1);
  for (auto& [which, outcome] : results.outcomes) outcome.runs.front().completion.reset();
  EXPECT_TRUE(means_are_decided(published, results, 0, 4, 0.98));
}

/// The truth is just beyond a tenth, where an error is most likely: in how many of the samples the
/// looks decide that a mean is close.
unsigned errors_of(unsigned samples, double confidence) {
  const Published published = shipped_figures();
  const double close = 1.1 * published.values("observed_means.np4.completion_s.baseline")[0];
  unsigned errors = 0;
  for (unsigned seed = 0; seed < samples; ++seed) {
    for (const std::size_t draws : looks(5)) {
      const Results results = drawn(published, 1.101, draws, seed);
      if (!means_are_decided(published, results, 0, 4, confidence)) continue;
      double completion = 0;
      for (const auto& [which, outcome] : results.outcomes) {
        if (which.policy != model::HeartbeatPolicy::periodic) continue;
        completion += outcome.completion_s().value_or(0) / 15;
      }
      if (completion <= close) ++errors;
      break;
    }
  }
  return errors;
}

TEST(Decided, LooksTogetherErrAsRarelyAsTheySay) {
  constexpr unsigned samples = 500;
  EXPECT_LE(errors_of(samples, confidence_of_look(5)), samples / 20);
  EXPECT_GT(errors_of(samples, 0.3), samples / 20) << "the test notices who looks carelessly";
}

}  // namespace decided_test
}  // namespace stormproof::reproduce
