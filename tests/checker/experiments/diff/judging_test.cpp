// What counts as a regression of the costs, on runs made by hand.
#include "checker/experiments/diff/judging.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "checker/experiments/diff/costs.hpp"

namespace stormproof::diff {
namespace judging_test {

constexpr double never = std::numeric_limits<double>::infinity();

Policy policy() {
  Policy policy;
  policy.tolerances = {{Measure::completion, 0.25}, {Measure::messages, 0.25}};
  policy.unnoticed = model::Nanoseconds{0};
  return policy;
}

ReviewedPoint point(bool drawn) {
  ReviewedPoint point;
  point.name = "point";
  point.base.deployment = model::Deployment::homogeneous(2, 2, 4);
  if (drawn) point.base.deployment.schedule.emplace();
  point.candidate = point.base;
  return point;
}

RunValues run(double completion, double messages = 100, double repairs = 0) {
  RunValues values{};
  values[static_cast<std::size_t>(Measure::completion)] = completion;
  values[static_cast<std::size_t>(Measure::messages)] = messages;
  values[static_cast<std::size_t>(Measure::initial_data)] = 50;
  values[static_cast<std::size_t>(Measure::repair_data)] = repairs;
  return values;
}

/// Completions spread by ±10 % around the two values.
PairedRuns runs(std::size_t count, double before, double after) {
  PairedRuns pairs;
  pairs.identical = false;
  for (std::size_t k = 0; k < count; ++k) {
    const double there =
        0.9 + 0.2 * static_cast<double>((7 * k) % count) / static_cast<double>(count);
    const double here = 0.9 + 0.2 * static_cast<double>(k) / static_cast<double>(count);
    pairs.before.push_back(run(before * here));
    pairs.after.push_back(run(after * there));
  }
  pairs.health_before = pairs.health_after = std::vector(count, exact::Health::fine);
  return pairs;
}

Configuration judged(const PairedRuns& pairs, const Policy& by = policy(), bool drawn = true,
                     std::size_t points = 1) {
  const std::vector<ReviewedPoint> all(points, point(drawn));
  return CostJudge{by, all, 1}.judge(all.front(), pairs);
}

Judgment completion(const PairedRuns& pairs) { return judged(pairs)[Measure::completion].judgment; }

TEST(CostJudge, ClearCases) {
  EXPECT_EQ(completion(runs(12, 1e9, 2e9)), Judgment::regression);
  EXPECT_EQ(completion(runs(12, 2e9, 1e9)), Judgment::better);
  EXPECT_EQ(completion(runs(24, 1e9, 1e9)), Judgment::same);
  EXPECT_EQ(completion(runs(24, 1e9, 1.13e9)), Judgment::worse);
  EXPECT_EQ(completion(runs(12, 1e9, 1.25e9)), Judgment::unclear);
}

/// Of runs that were cut only the least is known, in every measure.
TEST(CostJudge, WhatWasCutIsNoMeasurement) {
  const auto cut = [](double before, double after) {
    PairedRuns pairs = runs(12, before, after);
    pairs.cut_at = model::Nanoseconds{4'000'000'000};
    return pairs;
  };
  EXPECT_EQ(completion(cut(never, 1e9)), Judgment::better);
  EXPECT_EQ(completion(cut(1e9, never)), Judgment::regression);
  EXPECT_EQ(completion(cut(never, never)), Judgment::unclear) << "nobody knows which is longer";
  EXPECT_EQ(completion(runs(12, never, never)), Judgment::same) << "neither ever completes";
  EXPECT_EQ(completion(cut(3.9e9, never)), Judgment::unclear) << "at least by 3 %";
  // Base and candidate send 100 each; if one was cut, it sends more.
  EXPECT_EQ(judged(cut(1e9, never))[Measure::messages].judgment, Judgment::unclear);
  // Nor are many of them together.
  const PairedRuns both = cut(never, never);
  CostJudge judge{policy(), {point(true)}, 1};
  std::vector<Configuration> one{judge.judge(point(true), both)};
  for (const PooledChange& pooled : judge.settle(one, {&both})) {
    EXPECT_EQ(pooled.judgment, Judgment::unclear) << name_of(pooled.measure);
  }
  PairedRuns chatty = cut(1e9, never);
  for (RunValues& run : chatty.after) run[index_of(Measure::messages)] = 150;
  EXPECT_EQ(judged(chatty)[Measure::messages].judgment, Judgment::regression);
  PairedRuns quiet = cut(never, 1e9);
  for (RunValues& run : quiet.after) run[index_of(Measure::messages)] = 150;
  EXPECT_EQ(judged(quiet)[Measure::messages].judgment, Judgment::unclear);
}

/// Eight times as long, and nobody waits longer.
TEST(CostJudge, AMomentIsNoRegression) {
  Policy patient = policy();
  patient.unnoticed = Policy{}.unnoticed;
  const auto judgment = [&](const PairedRuns& pairs, Measure measure) {
    return judged(pairs, patient)[measure].judgment;
  };
  EXPECT_EQ(judgment(runs(12, 15e6, 121e6), Measure::completion), Judgment::worse);
  EXPECT_EQ(judgment(runs(12, 15e6, 400e6), Measure::completion), Judgment::regression);
  // Neither are unclear ones unclear; too few runs still are.
  EXPECT_EQ(judgment(runs(12, 100e6, 125e6), Measure::completion), Judgment::worse);
  EXPECT_EQ(judgment(runs(3, 15e6, 121e6), Measure::completion), Judgment::unclear);
  EXPECT_EQ(completion(runs(12, 15e6, 121e6)), Judgment::regression);
  // Of messages there is no such amount.
  PairedRuns chatty = runs(12, 15e6, 15e6);
  for (RunValues& one : chatty.after) one[static_cast<std::size_t>(Measure::messages)] = 200;
  EXPECT_EQ(judgment(chatty, Measure::messages), Judgment::regression);
}

TEST(CostJudge, TooFewRunsSettleNothing) {
  EXPECT_EQ(completion(runs(1, 1e9, 9e9)), Judgment::unclear);
  EXPECT_EQ(completion(runs(3, 1e9, 9e9)), Judgment::unclear);
}

TEST(CostJudge, OneTrajectoryIsAFact) {
  const Configuration slower = judged(runs(1, 1e9, 2e9), policy(), false);
  EXPECT_EQ(slower[Measure::completion].judgment, Judgment::regression);
  EXPECT_TRUE(slower[Measure::completion].shift->exact);
  EXPECT_NEAR(*slower[Measure::completion].relative, 1, 1e-9);
  EXPECT_EQ(judged(runs(1, 1e9, 1.2e9), policy(), false)[Measure::completion].judgment,
            Judgment::worse);
  EXPECT_EQ(judged(runs(1, 2e9, 1e9), policy(), false)[Measure::completion].judgment,
            Judgment::better);
}

TEST(CostJudge, RunsThatDoNotComplete) {
  PairedRuns pairs = runs(12, 1e9, 1e9);
  for (RunValues& values : pairs.after) values[0] = never;
  pairs.health_after.assign(12, exact::Health::incomplete);
  EXPECT_EQ(completion(pairs), Judgment::regression);
  EXPECT_FALSE(judged(pairs)[Measure::completion].shift);
  std::swap(pairs.before, pairs.after);
  EXPECT_EQ(completion(pairs), Judgment::better);
  pairs.after = pairs.before;  // with neither
  pairs.health_before = pairs.health_after;
  const Configuration neither = judged(pairs);
  EXPECT_EQ(neither[Measure::completion].judgment, Judgment::same);
  EXPECT_FALSE(neither[Measure::completion].reason.empty());
  EXPECT_FALSE(neither.storm_before) << "not complete alone is no storm";
}

TEST(CostJudge, AStormIsOneByTheDefinitionOfRuns) {
  PairedRuns pairs = runs(12, 1e9, 1e9);
  for (std::size_t k = 0; k < 5; ++k) pairs.health_after[k] = exact::Health::storm;
  EXPECT_FALSE(judged(pairs).storm_after);
  pairs.health_after[7] = exact::Health::incomplete;
  EXPECT_FALSE(judged(pairs).storm_after);
  pairs.health_after[7] = exact::Health::storm;  // half of them
  EXPECT_TRUE(judged(pairs).storm_after);
  EXPECT_FALSE(judged(pairs).storm_before);
  pairs.health_before.assign(12, exact::Health::slow_link);
  EXPECT_FALSE(judged(pairs).storm_before);
}

TEST(CostJudge, MeasuresWithoutToleranceAreOnlyShown) {
  PairedRuns pairs = runs(12, 1e9, 1e9);
  for (RunValues& values : pairs.after) {
    values[static_cast<std::size_t>(Measure::repair_data)] = 500;
  }
  const Configuration configuration = judged(pairs);
  EXPECT_EQ(configuration[Measure::repair_data].judgment, Judgment::worse);
  EXPECT_FALSE(configuration[Measure::repair_data].relative);  // the median before is 0
  EXPECT_EQ(judgment_of(configuration, policy()), Judgment::same);
  Policy strict = policy();
  strict.tolerances.push_back({Measure::repair_data, 0.25});
  EXPECT_EQ(judged(pairs, strict)[Measure::repair_data].judgment, Judgment::regression);
}

TEST(CostJudge, ManyConfigurationsNeedSurerIntervals) {
  const CostJudge one{policy(), {point(true)}, 1};
  const CostJudge many{policy(), std::vector<ReviewedPoint>(90, point(true)), 4};
  EXPECT_NEAR(1 - one.single_confidence(), 0.025 / 3, 1e-12);
  EXPECT_NEAR(1 - many.single_confidence(), 0.025 / (90 * 3 * 4), 1e-12);
}

TEST(CostJudge, NoChangeIsNoRegressionAsOftenAsPromised) {
  // 300 grids of five configurations without any change, of widely scattered runs: at most 5 % of
  // the grids may show a regression.
  std::mt19937_64 random{1};
  std::lognormal_distribution<double> storm{20, 0.6};
  const std::vector<ReviewedPoint> points(5, point(true));
  Policy tight = policy();
  tight.tolerances = {{Measure::completion, 0}};
  int wrong = 0;
  for (int grid = 0; grid < 300; ++grid) {
    CostJudge judge{tight, points, 1};
    std::vector<PairedRuns> all(points.size());
    std::vector<Configuration> configurations;
    std::vector<const PairedRuns*> pointers;
    for (PairedRuns& pairs : all) {
      pairs.identical = false;
      for (int k = 0; k < 12; ++k) {
        pairs.before.push_back(run(storm(random)));
        pairs.after.push_back(run(storm(random)));
      }
      configurations.push_back(judge.judge(points.front(), pairs));
      pointers.push_back(&pairs);
    }
    (void)judge.settle(configurations, pointers);
    bool regresses = false;
    for (const Configuration& each : configurations) {
      regresses = regresses || judgment_of(each, tight) == Judgment::regression;
    }
    wrong += regresses ? 1 : 0;
  }
  EXPECT_LE(wrong, 15);
}

TEST(CostJudge, UndecidedConfigurationsAreSettledTogether) {
  std::mt19937_64 random{3};
  std::lognormal_distribution<double> storm{20, 0.5};
  const std::vector<ReviewedPoint> points(8, point(true));
  const auto settled = [&](double factor) {
    CostJudge judge{policy(), points, 1};
    std::vector<PairedRuns> all(points.size());
    std::vector<Configuration> configurations;
    std::vector<const PairedRuns*> pointers;
    for (PairedRuns& pairs : all) {
      pairs.identical = false;
      for (int k = 0; k < 40; ++k) {
        pairs.before.push_back(run(storm(random)));
        pairs.after.push_back(run(factor * storm(random)));
      }
      configurations.push_back(judge.judge(points.front(), pairs));
      pointers.push_back(&pairs);
    }
    const auto pooled = judge.settle(configurations, pointers);
    return std::pair{pooled.empty() ? Judgment::better : pooled.front().judgment, configurations};
  };
  const auto [none, calm] = settled(1.0);
  EXPECT_EQ(none, Judgment::same);
  for (const Configuration& each : calm) EXPECT_FALSE(is_unclear(each));
  const auto [slower, bad] = settled(1.6);
  EXPECT_EQ(slower, Judgment::regression);
  EXPECT_EQ(settled(1.25).first, Judgment::unclear);
}

TEST(CostJudge, LimitsThatAreCrossed) {
  Policy limited = policy();
  limited.limits.emplace().completion = model::Nanoseconds{1'500'000'000};
  const Configuration worse = judged(runs(24, 1e9, 2e9), limited);
  ASSERT_EQ(worse.crossings.size(), 1U);
  EXPECT_EQ(worse.crossings[0].limit, "limit.completion");
  EXPECT_EQ(worse.crossings[0].text, "completion 1.5s");
  EXPECT_EQ(worse.crossings[0].before, 0);
  EXPECT_EQ(worse.crossings[0].after, 1);
  EXPECT_EQ(worse.crossings[0].judgment, Judgment::regression);
  EXPECT_EQ(judged(runs(24, 2e9, 1e9), limited).crossings.at(0).judgment, Judgment::better);
  EXPECT_TRUE(judged(runs(24, 1e9, 1.2e9), limited).crossings.empty());
  EXPECT_TRUE(judged(runs(24, 2e9, 3e9), limited).crossings.empty());
  // Two of 24 runs are more than 5 %, but do not show that the rate is.
  PairedRuns few = runs(24, 1e9, 1e9);
  few.after[3][0] = few.after[9][0] = 2e9;
  EXPECT_EQ(judged(few, limited).crossings.at(0).judgment, Judgment::unclear);
}

TEST(Margins, AreTheHighestLoadWithoutAStorm) {
  CostComparison costs;
  costs.confidence = 0.99;
  for (std::uint64_t load : {100U, 200U, 300U}) {
    Configuration each;
    each.name = std::to_string(load);
    each.descriptors = load;
    each.storm_after = load >= 200;
    each.measures[0].shift = Shift{0, -1, 1, 0.99, false};
    each.measures[3].shift = Shift{50, 10, 90, 0.99, false};
    costs.configurations.push_back(each);
  }
  const model::DdsProfile dds;
  const MarginComparison worse = compare_margins(dds, dds, {}, costs, policy());
  EXPECT_EQ(worse.before.load, 300U);
  EXPECT_EQ(worse.after.load, 100U);
  EXPECT_EQ(worse.judgment, Judgment::regression);
  Policy tolerant = policy();
  tolerant.margin = false;
  EXPECT_EQ(compare_margins(dds, dds, {}, costs, tolerant).judgment, Judgment::worse);
  // The same flips without a shift that is beyond chance are none.
  for (Configuration& each : costs.configurations) each.measures[3].shift->low = -5;
  EXPECT_EQ(compare_margins(dds, dds, {}, costs, policy()).judgment, Judgment::same);
}

TEST(Margins, ThresholdOfTheTheorem) {
  model::DdsProfile base;
  model::DdsProfile shorter = base;
  shorter.sedp.heartbeat_response_delay = model::Nanoseconds{4'000};
  const CostComparison none;
  const MarginComparison margin = compare_margins(base, shorter, {}, none, policy());
  EXPECT_EQ(margin.before.threshold->count(), 10'000);
  EXPECT_EQ(margin.after.threshold->count(), 4'000);
  EXPECT_EQ(margin.judgment, Judgment::regression);
  EXPECT_EQ(compare_margins(shorter, base, {}, none, policy()).judgment, Judgment::better);
  EXPECT_EQ(compare_margins(base, base, {}, none, policy()).judgment, Judgment::same);
  // It is about deployments to which it applies, and in which it is proved.
  std::vector<ReviewedPoint> busy(2);
  for (ReviewedPoint& point : busy) point.base.dds = base, point.candidate.dds = shorter;
  EXPECT_TRUE(compare_margins(base, shorter, busy, none, policy()).before.threshold);
  busy.back().base.wireless.sender = model::Sender::stalls;
  const MarginComparison unknown = compare_margins(base, shorter, busy, none, policy());
  EXPECT_FALSE(unknown.before.threshold);
  EXPECT_NE(unknown.before.formula.find("sender: stalls"), std::string::npos);
  EXPECT_TRUE(unknown.after.threshold);
  // Delays are equal if all packets of all deployments have the same.
  for (ReviewedPoint& point : busy) {
    point.base.wireless = {};
    point.base.wireless.kind = model::ServiceKind::constant_delay;
  }
  EXPECT_EQ(compare_margins(base, base, busy, none, policy()).before.threshold->count(),
            70'090'000);
  busy.front().base.wireless.packet_delays = {{0, {}, model::Nanoseconds{5}}};
  EXPECT_EQ(compare_margins(base, base, busy, none, policy()).before.threshold->count(), 10'000);
  // A load that the runs show to be higher counts before it.
  CostComparison calmer;
  calmer.configurations.emplace_back();
  calmer.configurations[0].storm_before = true;
  calmer.configurations[0].measures[0].shift = Shift{-1, -1, -1, 1, true};
  EXPECT_EQ(compare_margins(base, shorter, {}, calmer, policy()).judgment, Judgment::better);
}

}  // namespace judging_test
}  // namespace stormproof::diff
