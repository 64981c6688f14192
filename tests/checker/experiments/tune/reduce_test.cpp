// Changes that do not matter are set back, those that do are kept.
#include "checker/experiments/tune/reduce.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "checker/experiments/statistics/completion.hpp"
#include "tests/checker/experiments/tune/stand_in.hpp"

namespace stormproof::tune {
namespace reduce_test {

/// The first knob halves completion, the second saves a fifth of the messages, the third a
/// thousandth of completion; the others nothing.
Cost few_matter(const Point& point) {
  const bool first = point[0] > 0;
  const bool second = point[1] > 0;
  const bool third = point[2] > 0;
  return {1e8 * (first ? 0.5 : 1) * (third ? 0.999 : 1), 1'000 * (second ? 0.8 : 1)};
}

constexpr Seeds seeds{100, 40};

/// Which knobs a point has changed from 0.
std::vector<std::size_t> changed(const Point& point) {
  return space_of_knobs(point.size(), 0).changes(point);
}
using Changed = std::vector<std::size_t>;

std::vector<Point> reduce_with(const Problem& problem, std::vector<Point> points,
                               double least = 0.02, Seeds under = seeds) {
  trials::Runner runner{1};
  Archive archive{problem, stand_in_limit, runner};
  auto result = reduced(std::move(points), problem, archive, under, least);
  EXPECT_TRUE(result);
  return result.value_or(std::vector<Point>{});
}

TEST(TuneReduce, KeepsWhatMatters) {
  const Problem problem = problem_of(space_of_knobs(5, 0), few_matter, 0.1);
  const auto result = reduce_with(problem, {{7, 7, 7, 7, 7}});
  ASSERT_EQ(result.size(), 1U);
  EXPECT_EQ(changed(result.front()), (Changed{0, 1}));
}

TEST(TuneReduce, WithoutNoiseOnlyTheLeastGainDecides) {
  const Problem problem = problem_of(space_of_knobs(5, 0), few_matter, 0);
  EXPECT_EQ(changed(reduce_with(problem, {{7, 7, 7, 7, 7}}).front()), (Changed{0, 1}));
  EXPECT_EQ(changed(reduce_with(problem, {{7, 7, 7, 7, 7}}, 0.0001).front()), (Changed{0, 1, 2}));
  EXPECT_EQ(changed(reduce_with(problem, {{7, 7, 7, 7, 7}}, 0.3).front()), (Changed{0}));
}

TEST(TuneReduce, OneRunIsAFactWhereAllRunsAreTheSame) {
  const Problem problem = problem_of(space_of_knobs(5, 0), few_matter, 0);
  EXPECT_EQ(changed(reduce_with(problem, {{7, 7, 7, 7, 7}}, 0.02, {0, 1}).front()),
            (Changed{0, 1}));
}

/// Each of six changes gains 1.5 %: none is worth a line alone, but all together are.
TEST(TuneReduce, SmallLossesDoNotAddUp) {
  const Formula each_a_little = [](const Point& point) {
    double completion = 1e8;
    for (const std::int64_t value : point) completion *= value > 0 ? 0.985 : 1;
    return Cost{completion, 10};
  };
  const Problem problem = problem_of(space_of_knobs(6, 0), each_a_little, 0);
  const auto result = reduce_with(problem, {{1, 1, 1, 1, 1, 1}});
  EXPECT_EQ(problem.space.changes(result.front()).size(), 5U);
}

/// Two changes of which either alone does it: one is enough, and not both are set back.
TEST(TuneReduce, OneOfTwoThatDoTheSame) {
  const Formula either = [](const Point& point) {
    return Cost{point[0] > 0 || point[1] > 0 ? 5e7 : 1e8, 10};
  };
  const Problem problem = problem_of(space_of_knobs(2, 0), either, 0.05);
  const auto result = reduce_with(problem, {{9, 9}});
  EXPECT_EQ(problem.space.changes(result.front()).size(), 1U);
}

/// Setting the second knob back would cost nothing, but break a property.
TEST(TuneReduce, SetsNothingBackThatWouldBreak) {
  Problem problem = problem_of(
      space_of_knobs(2, 0),
      [](const Point& point) {
        return Cost{point[0] > 0 ? 5e7 : 1e8, 10};
      },
      0);
  const auto run = problem.run;
  problem.run = [run](const Point& point, std::uint64_t seed, model::Nanoseconds limit) {
    auto outcome = run(point, seed, limit);
    if (point[0] > 0 && point[1] == 0) outcome->broken.emplace_back("planted.property");
    return outcome;
  };
  EXPECT_EQ(changed(reduce_with(problem, {{9, 9}}).front()), (Changed{0, 1}));

  problem.run = run;
  problem.watch = [](const Point& point, std::uint64_t,
                     model::Nanoseconds) -> std::optional<std::vector<std::string_view>> {
    if (point[0] > 0 && point[1] == 0) return std::vector<std::string_view>{"planted.property"};
    return std::vector<std::string_view>{};
  };
  EXPECT_EQ(changed(reduce_with(problem, {{9, 9}}).front()), (Changed{0, 1}));
}

TEST(TuneReduce, AllPointsGoTheirOwnWay) {
  const Problem problem = problem_of(space_of_knobs(5, 0), few_matter, 0.1);
  const auto result = reduce_with(problem, {{7, 0, 7, 0, 0}, {0, 0, 0, 0, 0}, {0, 3, 0, 3, 3}});
  ASSERT_EQ(result.size(), 3U);
  EXPECT_EQ(changed(result[0]), (Changed{0}));
  EXPECT_EQ(changed(result[1]), (Changed{}));
  EXPECT_EQ(changed(result[2]), (Changed{1}));
}

/// Beyond 100 the knob does nothing more: part of the way back, and again, but not below.
TEST(TuneReduce, GoesNoFurtherThanItHelps) {
  const Formula saturating = [](const Point& point) {
    return Cost{2e8 - 1e6 * static_cast<double>(std::min<std::int64_t>(point[0], 100)), 10};
  };
  const Problem problem = problem_of(space_of_knobs(1, 0), saturating, 0);
  const std::int64_t value = reduce_with(problem, {{1'000}}).front()[0];
  EXPECT_GE(value, 100);
  EXPECT_LT(value, 300);
  EXPECT_EQ(reduce_with(problem, {{90}}).front()[0], 90) << "every step back costs something";
}

/// How many problems are reduced to the same with early looks and without, and what runs it takes.
struct EarlyLooks {
  std::size_t same = 0, problems = 0;
  std::size_t runs = 0, all_runs = 0;
};

EarlyLooks early_looks(double spread) {
  EarlyLooks looks;
  for (std::uint64_t first = 0; first < 200; ++first) {
    const Problem problem = problem_of(space_of_knobs(5, 0), few_matter, spread);
    const Seeds under{1'000 * first, 40};
    const std::vector<Point> point{{7, 7, 7, static_cast<std::int64_t>(first + 1), 7}};
    trials::Runner runner{1};
    Archive early{problem, stand_in_limit, runner};
    Archive late{problem, stand_in_limit, runner};
    const auto one = reduced(point, problem, early, under, 0.02);
    const auto other = reduced(point, problem, late, under, 0.02, 1);
    ++looks.problems;
    if (one == other) ++looks.same;
    looks.runs += early.runs();
    looks.all_runs += late.runs();
  }
  return looks;
}

/// What matters much is seen early; what hardly matters is not taken for more by looking often.
TEST(TuneReduce, LooksEarlyAndDecidesTheSame) {
  for (const double spread : {0.1, 0.5, 0.9}) {
    const EarlyLooks looks = early_looks(spread);
    EXPECT_GE(looks.same, looks.problems - 1) << spread;
    EXPECT_LE(looks.runs, looks.all_runs) << spread;
  }
  const EarlyLooks clear = early_looks(0.1);
  EXPECT_LT(clear.runs * 10, clear.all_runs * 9);
}

/// Where nothing matters, giving up is an error. Each look errs one time in a thousand.
TEST(TuneReduce, GivesUpHardlyAnythingByMistake) {
  const Formula nothing = [](const Point&) { return Cost{1e8, 1'000}; };
  const Problem problem = problem_of(space_of_knobs(1, 0), nothing, 0.9);
  std::size_t given_up = 0;
  constexpr std::size_t trials = 4'000;
  for (std::uint64_t k = 0; k < trials; ++k) {
    const Point original{static_cast<std::int64_t>(k + 1)};
    trials::Runner runner{1};
    Archive archive{problem, stand_in_limit, runner};
    ASSERT_TRUE(reduced({original}, problem, archive, {100 * k, 40}, 0));
    if (archive.outcomes({0}, {100 * k, 40}).size() < 40) ++given_up;
  }
  EXPECT_LE(given_up, trials * 3 / 1'000);
}

Outcome incomplete(double missing) {
  Outcome outcome;
  outcome.missing = missing;
  return outcome;
}

TEST(TuneDifference, OfRunsThatDoNotComplete) {
  const std::vector<Outcome> all(6, outcome_of(1e9, 100));
  const std::vector<Outcome> none(6, incomplete(0.5));
  EXPECT_TRUE(is_clearly_more(difference(none, all).completion, 0.02));
  EXPECT_TRUE(is_clearly_less(difference(all, none).completion, 0.02));
  // Of two runs that both do not complete nothing is known, whatever they miss.
  const std::vector<Outcome> neither(6, incomplete(0.1));
  EXPECT_FALSE(is_clearly_more(difference(none, neither).completion, 0.02));
  EXPECT_FALSE(is_clearly_less(difference(neither, none).completion, 0.02));
}

/// What was cut takes longer, and no more is known.
TEST(TuneDifference, OfRunsThatWereCut) {
  Outcome cut = incomplete(0.5);
  cut.cut = model::Nanoseconds{4'000'000'000};
  cut.counts.heartbeat = 400;
  const std::vector<Outcome> longer(6, cut);
  const std::vector<Outcome> all(6, outcome_of(1e9, 100));
  const Difference less = difference(all, longer);
  EXPECT_DOUBLE_EQ(less.completion.estimate, std::log(0.25)) << "at least by so much";
  EXPECT_DOUBLE_EQ(less.completion.high, std::log(0.25));
  EXPECT_EQ(less.completion.low, -statistics::unreached);
  EXPECT_TRUE(is_clearly_less(less.completion, 0.02));
  EXPECT_TRUE(is_clearly_less(less.messages, 0.02));
  EXPECT_TRUE(is_clearly_more(difference(longer, all).completion, 0.02));
  // It sends at least 400, so nobody knows whether 500 are more.
  const std::vector<Outcome> chatty(6, outcome_of(1e9, 500));
  EXPECT_FALSE(is_clearly_more(difference(chatty, longer).messages, 0.02));
  const Difference neither = difference(longer, longer);
  EXPECT_FALSE(neither.completion.is_less() || neither.completion.is_more());
  EXPECT_FALSE(neither.messages.is_less() || neither.messages.is_more());
}

TEST(TuneCost, OfRunsThatDoNotCompleteIsWhatTheyMiss) {
  const std::vector<Outcome> mostly{outcome_of(1e9, 10), outcome_of(3e9, 10), incomplete(0.5)};
  EXPECT_EQ(cost_of(mostly), (Cost{3e9, 10, 0}));
  const std::vector<Outcome> rarely{outcome_of(1e9, 10), incomplete(0.2), incomplete(0.5)};
  EXPECT_EQ(cost_of(rarely).completion, statistics::unreached);
  EXPECT_EQ(cost_of(rarely).missing, 0.2);
}

}  // namespace reduce_test
}  // namespace stormproof::tune
