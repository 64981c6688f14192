// The search on costs whose optimum is known.
#include "checker/experiments/tune/search.hpp"

#include <atomic>
#include <mutex>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/checker/experiments/tune/stand_in.hpp"

namespace stormproof::tune {
namespace search_test {

/// Shortest at 400 in the first knob and 800 in the second; messages do not matter. The others do
/// nothing.
Cost planted(const Point& point) {
  const double a = (static_cast<double>(point[0]) - 400) / 1'000;
  const double b = (static_cast<double>(point[1]) - 800) / 1'000;
  return {1e8 * (1 + 8 * a * a + 8 * b * b), 1'000};
}

SearchResult search_in(const Problem& problem, std::size_t threads, SearchOptions options) {
  trials::Runner runner{threads};
  Archive archive{problem, stand_in_limit, runner};
  return search(problem, archive, options);
}

TEST(TuneSearch, FindsAPlantedOptimum) {
  const Problem problem = problem_of(space_of_knobs(5, 0), planted, 0);
  const SearchResult result = search_in(problem, 1, {1'500, {0, 12}, 1});
  ASSERT_FALSE(result.front.empty());
  const Point& best = result.front.front();
  EXPECT_NEAR(static_cast<double>(best[0]), 400, 60);
  EXPECT_NEAR(static_cast<double>(best[1]), 800, 60);
  EXPECT_LT(planted(best).completion, 1.05e8);
}

TEST(TuneSearch, FindsItUnderNoise) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Problem problem = problem_of(space_of_knobs(5, 0), planted, 0.1);
    const SearchResult result = search_in(problem, 1, {1'500, {0, 12}, seed});
    ASSERT_FALSE(result.front.empty());
    EXPECT_LT(planted(result.front.front()).completion, 1.3e8) << "unchanged: 7.4e8";
  }
}

TEST(TuneSearch, AFlatCostHasOneAnswer) {
  const Problem problem = problem_of(
      space_of_knobs(2, 500),
      [](const Point&) {
        return Cost{1e8, 10};
      },
      0);
  const SearchResult result = search_in(problem, 1, {300, {0, 4}, 1});
  ASSERT_EQ(result.front.size(), 1U);
  EXPECT_EQ(result.front.front(), problem.space.unchanged());
}

TEST(TuneSearch, SpreadsOverAFront) {
  // The first knob trades completion for messages.
  const Formula trade = [](const Point& point) {
    const double x = static_cast<double>(point[0]);
    const double waste = 1 + static_cast<double>(point[1]) / 1'000;
    return Cost{1e8 * waste / (1 + x / 100), 100 * waste * (1 + x / 100)};
  };
  const Problem problem = problem_of(space_of_knobs(2, 1'000), trade, 0);
  const SearchResult result = search_in(problem, 1, {1'500, {0, 4}, 1});
  EXPECT_GE(result.front.size(), 8U);
  EXPECT_GE(result.front.front()[0], 950);
  EXPECT_LE(result.front.back()[0], 50);
  for (const Point& point : result.front) EXPECT_LE(point[1], 60);
}

/// Storms beyond a valley; how long each run was simulated is added up.
struct Storms {
  Problem problem = problem_of(space_of_knobs(4, 0), planted, 0.1);
  std::atomic<std::int64_t> simulated = 0;

  Storms() {
    problem.run = [this, whole = problem.run](const Point& point, std::uint64_t seed,
                                              model::Nanoseconds limit) {
      auto outcome = whole(point, seed, limit);
      const bool storms = point[2] < 300;
      if (storms || *outcome->completion > limit) outcome->completion.reset();
      simulated += outcome->completion.value_or(limit).count();
      return outcome;
    };
  }
  SearchResult search(trials::Patience patience, std::size_t threads, std::size_t* cuts = nullptr) {
    trials::Runner runner{threads};
    Archive archive{problem, patience, runner};
    const SearchResult result = tune::search(problem, archive, {1'500, {0, 12}, 1});
    if (cuts != nullptr) *cuts = archive.cuts();
    return result;
  }
};

constexpr model::Nanoseconds long_limit{60'000'000'000};
constexpr model::Nanoseconds late{1'000'000};

TEST(TuneSearch, StormsAreCutByWhatTheBestTakes) {
  Storms whole;
  const SearchResult full = whole.search(long_limit, 1);
  Storms cut;
  std::size_t cuts = 0;
  const SearchResult raced = cut.search({long_limit, late}, 1, &cuts);
  EXPECT_GT(cuts, 0U);
  EXPECT_LT(cut.simulated, whole.simulated / 5);
  ASSERT_FALSE(full.front.empty());
  ASSERT_FALSE(raced.front.empty());
  EXPECT_LT(planted(raced.front.front()).completion, 1.05 * planted(full.front.front()).completion);
  for (const Point& point : raced.front) EXPECT_GE(point[2], 300);
  // Nothing that was cut counts as measured, whoever was faster.
  EXPECT_EQ(cut.search({long_limit, late}, 4).front, raced.front);
}

TEST(TuneSearch, ItsTimeEndsIt) {
  const Problem problem = problem_of(space_of_knobs(4, 0), planted, 0.2);
  SearchOptions options{100'000, {0, 12}, 5};
  std::size_t asked = 0;
  options.time_used = [&asked] { return static_cast<double>(++asked) / 20; };
  const SearchResult result = search_in(problem, 1, options);
  EXPECT_TRUE(result.finished);
  EXPECT_LT(result.generations, 20U);
}

TEST(TuneSearch, DoesNotDependOnThreads) {
  const Problem problem = problem_of(space_of_knobs(4, 0), planted, 0.2);
  const SearchResult one = search_in(problem, 1, {800, {0, 12}, 5});
  const SearchResult four = search_in(problem, 4, {800, {0, 12}, 5});
  EXPECT_EQ(one.front, four.front);
  EXPECT_EQ(one.finalists, four.finalists);
  EXPECT_EQ(one.generations, four.generations);
  const SearchResult other = search_in(problem, 4, {800, {0, 12}, 6});
  EXPECT_NE(one.finalists, other.finalists);  // so the comparison above says something
}

TEST(TuneSearch, KeepsToItsBudget) {
  const Problem problem = problem_of(space_of_knobs(4, 0), planted, 0.2);
  trials::Runner runner{1};
  Archive archive{problem, stand_in_limit, runner};
  const SearchResult result = search(problem, archive, {1'000, {0, 12}, 5});
  EXPECT_GE(archive.runs(), 1'000U);
  EXPECT_LE(archive.runs(), 1'000U + 16 * 12);
  EXPECT_GT(result.generations, 3U);
}

TEST(TuneSearch, RunsNothingTwice) {
  std::mutex mutex;
  std::map<std::pair<Point, std::uint64_t>, int> asked;
  Problem problem = problem_of(space_of_knobs(3, 0), planted, 0.2);
  const auto run = problem.run;
  problem.run = [&](const Point& point, std::uint64_t seed, model::Nanoseconds limit) {
    const std::lock_guard lock{mutex};
    ++asked[{point, seed}];
    return run(point, seed, limit);
  };
  trials::Runner runner{2};
  Archive archive{problem, stand_in_limit, runner};
  static_cast<void>(search(problem, archive, {600, {0, 8}, 2}));
  for (const auto& [what, times] : asked) EXPECT_EQ(times, 1);
  EXPECT_EQ(asked.size(), archive.runs());
}

/// The shortest settings break a property; the search has to stop before them.
TEST(TuneSearch, RefusesWhatBreaksAProperty) {
  Problem problem = problem_of(space_of_knobs(2, 0), planted, 0);
  const auto run = problem.run;
  problem.run = [run](const Point& point, std::uint64_t seed, model::Nanoseconds limit) {
    auto outcome = run(point, seed, limit);
    if (point[0] > 200) outcome->broken.emplace_back("planted.property");
    return outcome;
  };
  const SearchResult result = search_in(problem, 1, {1'200, {0, 8}, 1});
  ASSERT_FALSE(result.front.empty());
  for (const Point& point : result.front) EXPECT_LE(point[0], 200);
  EXPECT_GE(result.front.front()[0], 150);
  EXPECT_GT(result.rejected, 0U);
  EXPECT_EQ(result.rejected_by.at("planted.property"), result.rejected);
}

/// The same if it costs much to see it: then only those are watched that might be in the front.
TEST(TuneSearch, WatchesOnlyWhatTheFrontRestsOn) {
  Problem problem = problem_of(space_of_knobs(2, 0), planted, 0);
  std::atomic<std::size_t> watched = 0;
  problem.watch = [&](const Point& point, std::uint64_t seed,
                      model::Nanoseconds) -> std::optional<std::vector<std::string_view>> {
    ++watched;
    if (point[0] > 200 && seed == 7) return std::vector<std::string_view>{"planted.property"};
    return std::vector<std::string_view>{};
  };
  trials::Runner runner{1};
  Archive archive{problem, stand_in_limit, runner};
  const SearchResult result = search(problem, archive, {1'200, {0, 8}, 1});
  ASSERT_TRUE(result.finished);
  ASSERT_FALSE(result.front.empty());
  for (const Point& point : result.front) EXPECT_LE(point[0], 200);
  EXPECT_GE(result.front.front()[0], 150);
  EXPECT_EQ(result.rejected_by.at("planted.property"), result.rejected);
  EXPECT_GE(watched, 8 * result.front.size());
  EXPECT_LT(watched, archive.runs());
}

/// It breaks under one seed only, the last.
TEST(TuneSearch, RefusesWhatBreaksRarely) {
  Problem problem = problem_of(
      space_of_knobs(1, 0),
      [](const Point& point) {
        return Cost{1e8 - static_cast<double>(point[0]), 10};
      },
      0);
  const auto run = problem.run;
  problem.run = [run](const Point& point, std::uint64_t seed, model::Nanoseconds limit) {
    auto outcome = run(point, seed, limit);
    if (point[0] > 500 && seed == 7) outcome->broken.emplace_back("planted.property");
    return outcome;
  };
  const SearchResult result = search_in(problem, 1, {400, {0, 8}, 1});
  ASSERT_FALSE(result.front.empty());
  EXPECT_LE(result.front.front()[0], 500);
}

TEST(TuneSearch, InvalidSettingsAreNeverRun) {
  Problem problem = problem_of(space_of_knobs(2, 0), planted, 0);
  problem.is_valid = [](const Point& point) { return point[0] + point[1] <= 600; };
  const auto run = problem.run;
  problem.run = [&problem, run](const Point& point, std::uint64_t seed, model::Nanoseconds limit) {
    EXPECT_TRUE(problem.is_valid(point));
    return run(point, seed, limit);
  };
  const SearchResult result = search_in(problem, 1, {600, {0, 4}, 1});
  EXPECT_GT(result.finalists.size(), 10U);
}

TEST(TuneSearch, InterruptedItTellsWhatItKnows) {
  const Problem problem = problem_of(space_of_knobs(3, 0), planted, 0);
  trials::Runner runner{1, [](std::size_t runs, std::size_t) { return runs < 500; }};
  Archive archive{problem, stand_in_limit, runner};
  const SearchResult result = search(problem, archive, {5'000, {0, 12}, 1});
  EXPECT_FALSE(result.finished);
  EXPECT_LE(archive.runs(), 500U);
  ASSERT_FALSE(result.front.empty());
  EXPECT_LT(planted(result.front.front()).completion,
            planted(problem.space.unchanged()).completion);
}

TEST(TuneSearch, IncompleteRunsAreWorseTheMoreIsMissing) {
  Outcome almost, hardly;
  almost.missing = 0.1;
  hardly.missing = 0.9;
  const Outcome complete = outcome_of(5e8, 10);
  const auto cost = [](const Outcome& outcome) {
    const Cost one = cost_of(std::vector{outcome});
    return std::pair{one.completion, one.missing};
  };
  EXPECT_LT(cost(complete), cost(almost));
  EXPECT_LT(cost(almost), cost(hardly));
}

}  // namespace search_test
}  // namespace stormproof::tune
