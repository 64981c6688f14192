// Dominance and fronts, held against their definitions.
#include "checker/experiments/tune/pareto.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

namespace stormproof::tune {
namespace pareto_test {

/// Small numbers, so that equal ones are common.
std::vector<Cost> random_costs() {
  const auto pairs = *rc::gen::container<std::vector<std::pair<int, int>>>(
      rc::gen::pair(rc::gen::inRange(0, 12), rc::gen::inRange(0, 12)));
  std::vector<Cost> costs;
  for (const auto& [completion, messages] : pairs) {
    costs.push_back({static_cast<double>(completion), static_cast<double>(messages)});
  }
  return costs;
}

using Dominates = bool (*)(const Cost&, const Cost&);

/// What a front is: no member is dominated, and everything else is dominated by a member or equal
/// to one.
bool is_front(const std::vector<Cost>& costs, const std::vector<std::size_t>& front,
              Dominates better) {
  for (const std::size_t member : front) {
    for (const Cost& other : costs) {
      if (better(other, costs[member])) return false;
    }
  }
  for (const Cost& cost : costs) {
    const bool covered = std::ranges::any_of(front, [&](std::size_t member) {
      return costs[member] == cost || better(costs[member], cost);
    });
    if (!covered) return false;
  }
  return true;
}

TEST(Pareto, BetterInOneAndNoWorseInTheOther) {
  EXPECT_TRUE(dominates({1, 1}, {1, 2}));
  EXPECT_TRUE(dominates({1, 1}, {2, 1}));
  EXPECT_FALSE(dominates({1, 1}, {1, 1}));
  EXPECT_FALSE(dominates({1, 3}, {2, 2}));
  EXPECT_FALSE(dominates({2, 2}, {1, 3}));
}

RC_GTEST_PROP(Pareto, DominanceIsAStrictOrder, ()) {
  const std::vector<Cost> costs = random_costs();
  for (const Cost& a : costs) {
    RC_ASSERT(!dominates(a, a));
    for (const Cost& b : costs) {
      RC_ASSERT(!(dominates(a, b) && dominates(b, a)));
      for (const Cost& c : costs) {
        if (dominates(a, b) && dominates(b, c)) RC_ASSERT(dominates(a, c));
      }
    }
  }
}

RC_GTEST_PROP(Pareto, TheFrontIsTheFront, ()) {
  const std::vector<Cost> costs = random_costs();
  const std::vector<std::size_t> front = pareto_front(costs);
  RC_ASSERT(is_front(costs, front, dominates));
  RC_ASSERT(std::ranges::is_sorted(front, {}, [&](std::size_t k) { return costs[k].completion; }));
  const std::set<std::pair<double, double>> distinct = [&] {
    std::set<std::pair<double, double>> members;
    for (const std::size_t k : front) members.emplace(costs[k].completion, costs[k].messages);
    return members;
  }();
  RC_ASSERT(distinct.size() == front.size());
}

/// The check above can fail: fronts by mistaken ideas of dominance are none.
TEST(Pareto, MistakenDominanceIsNoticed) {
  const std::vector<Cost> costs{{1, 5}, {2, 2}, {2, 3}, {4, 1}, {4, 4}, {1, 6}};
  const auto by = [&](Dominates better) {
    std::vector<std::size_t> front;
    for (std::size_t k = 0; k < costs.size(); ++k) {
      if (std::ranges::none_of(costs, [&](const Cost& c) { return better(c, costs[k]); })) {
        front.push_back(k);
      }
    }
    return front;
  };
  EXPECT_TRUE(is_front(costs, by(dominates), dominates));
  const Dominates both_better = [](const Cost& a, const Cost& b) {
    return a.completion < b.completion && a.messages < b.messages;
  };
  const Dominates either_better = [](const Cost& a, const Cost& b) {
    return a.completion < b.completion || a.messages < b.messages;
  };
  const Dominates one_only = [](const Cost& a, const Cost& b) {
    return a.completion < b.completion;
  };
  const Dominates turned = [](const Cost& a, const Cost& b) { return dominates(b, a); };
  EXPECT_FALSE(is_front(costs, by(both_better), dominates));
  EXPECT_FALSE(is_front(costs, by(either_better), dominates));
  EXPECT_FALSE(is_front(costs, by(one_only), dominates));
  EXPECT_FALSE(is_front(costs, by(turned), dominates));
}

RC_GTEST_PROP(Pareto, RanksCountTheFrontsBefore, ()) {
  const std::vector<Cost> costs = random_costs();
  const std::vector<std::size_t> ranks = pareto_ranks(costs);
  for (std::size_t a = 0; a < costs.size(); ++a) {
    bool has_predecessor = ranks[a] == 0;
    for (std::size_t b = 0; b < costs.size(); ++b) {
      if (!dominates(costs[b], costs[a])) continue;
      RC_ASSERT(ranks[b] < ranks[a]);
      has_predecessor = has_predecessor || ranks[b] + 1 == ranks[a];
    }
    RC_ASSERT(has_predecessor);
  }
}

RC_GTEST_PROP(Pareto, PromiseOrdersEverythingByRank, ()) {
  const std::vector<Cost> costs = random_costs();
  const std::vector<std::size_t> order = by_promise(costs);
  const std::vector<std::size_t> ranks = pareto_ranks(costs);
  RC_ASSERT(std::set<std::size_t>(order.begin(), order.end()).size() == costs.size());
  RC_ASSERT(std::ranges::is_sorted(order, {}, [&](std::size_t k) { return ranks[k]; }));
}

TEST(Pareto, OfTwoThatAreNotReachedThatWhichMissesLess) {
  const double never = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(dominates({1e9, 5}, {never, 5, 0.1}));
  EXPECT_TRUE(dominates({never, 5, 0.1}, {never, 5, 0.2}));
  EXPECT_FALSE(dominates({never, 6, 0.1}, {never, 5, 0.2}));
  const std::vector<Cost> costs{{never, 5, 0.2}, {never, 9, 0.1}, {1e9, 10}, {never, 9, 0.3}};
  EXPECT_EQ(pareto_front(costs), (std::vector<std::size_t>{2, 1, 0}));
  EXPECT_EQ(by_promise(costs).back(), 3U);
}

TEST(Pareto, EndsOfTheFrontComeFirst) {
  const std::vector<Cost> costs{{2, 9}, {1, 10}, {2.1, 8.9}, {10, 1}, {5, 5}};
  const std::vector<std::size_t> order = by_promise(costs);
  EXPECT_EQ(order[0], 1U);
  EXPECT_EQ(order[1], 3U);
  EXPECT_EQ(order[2], 4U);  // the most room
}

TEST(Pareto, SpreadKeepsEndsAndFillsGaps) {
  const std::vector<Cost> costs{{1, 100}, {1.01, 99}, {1.02, 98}, {10, 10}, {100, 1}};
  const std::vector<std::size_t> shown = spread_out(costs, pareto_front(costs), 3);
  EXPECT_EQ(shown, (std::vector<std::size_t>{0, 3, 4}));
  EXPECT_EQ(spread_out(costs, pareto_front(costs), 9).size(), 5U);
}

}  // namespace pareto_test
}  // namespace stormproof::tune
