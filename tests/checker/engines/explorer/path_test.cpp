// Concrete times for a path, the graph of what can still happen, and replays that must not be
// believed.
#include "checker/engines/explorer/path.hpp"

#include <gtest/gtest.h>

#include "checker/engines/explorer/relation_world.hpp"
#include "checker/engines/explorer/replay.hpp"
#include "tests/checker/engines/explorer/tiny.hpp"

namespace stormproof::explorer {
namespace path_test {

using model::Nanoseconds;

TEST(EarliestTimes, AreTheLeastThatSatisfyAllConstraints) {
  // x1 in [3, 5], x2 at least 4 after x1, x2 <= 8.
  const auto times = earliest_times(3, {{0, 1, -3}, {1, 0, 5}, {1, 2, -4}, {2, 0, 8}});
  ASSERT_TRUE(times);
  EXPECT_EQ(*times, (std::vector<std::int64_t>{0, 3, 7}));
}

TEST(EarliestTimes, AContradictionHasNone) {
  EXPECT_FALSE(earliest_times(2, {{0, 1, -3}, {1, 0, 2}}));
  EXPECT_FALSE(earliest_times(3, {{1, 2, -1}, {2, 1, -1}}));
}

TEST(StateGraph, FindsWhatCannotReachTheGoal) {
  StateGraph graph;  // 0 → 1 → 2 (goal), 0 → 3 ⇄ 4
  graph.add({0, 1});
  graph.add({1, 2});
  graph.add({0, 3});
  graph.add({3, 4});
  graph.add({4, 3});
  graph.finish(5);
  EXPECT_EQ(graph.first_that_cannot_reach([](std::uint32_t k) { return k == 2; }), 3U);
  EXPECT_EQ(graph.first_that_cannot_reach([](std::uint32_t k) { return k == 2 || k == 4; }),
            std::nullopt);
}

TEST(StateGraph, TellsWhatMustHappenFromWhatCan) {
  const auto is_last = [](std::uint32_t state) { return state == 2; };
  StateGraph graph;
  graph.add({0, 1, 3, false});
  graph.add({1, 2, 1, false});
  graph.add({1, 3, 0, true});  // a loss
  graph.add({3, 3, 0, false});
  graph.finish(4);
  EXPECT_EQ(graph.first_that_cannot_reach(is_last), 3U);
  EXPECT_EQ(graph.count_not_bound_to_reach(is_last), 1U);
  EXPECT_EQ(graph.most_generated(10), 4U);
  graph.add({3, 2, 0, false});  // it can, but some of its times may go round for ever
  graph.add({2, 0, 1, false});  // and there is no end of DATA
  graph.finish(4);
  EXPECT_FALSE(graph.first_that_cannot_reach(is_last));
  EXPECT_EQ(graph.count_not_bound_to_reach(is_last), 1U);
  EXPECT_EQ(graph.most_generated(10), 11U);
}

/// A path in which a repair happens without a loss.
ConcretePath some_path(const model::Scenario& scenario, const Scope& scope) {
  RelationWorld world{scenario, scenario, scope, {}};
  SearchOptions options;
  options.claims = bit(Claim::free_threshold);
  const SearchResult result = Search<RelationWorld>{world, options}.run();
  const auto& labels = result.objections[static_cast<std::size_t>(Claim::free_threshold)];
  EXPECT_TRUE(labels);
  return *concrete_path(world, *labels, Claim::free_threshold, {});
}

Scope tiny_scope() {
  Scope scope;
  scope.least_delay = Nanoseconds{1};
  scope.largest_delay = Nanoseconds{3};
  return scope;
}

TEST(Replay, ATrueCounterexampleIsConfirmed) {
  const model::Scenario scenario = tiny_scenario();
  const Scope scope = tiny_scope();
  const ConcretePath path = some_path(scenario, scope);
  const ReplayOutcome outcome =
      replay({scenario, scenario, nullptr, scope, {}}, path, "storm.free-threshold");
  ASSERT_TRUE(outcome.counterexample) << outcome.why_not;
  EXPECT_EQ(outcome.counterexample->time, path.steps.back().time);
}

TEST(Replay, AnotherPropertyIsNotBrokenByTheSameRun) {
  const model::Scenario scenario = tiny_scenario();
  const Scope scope = tiny_scope();
  const ReplayOutcome outcome = replay({scenario, scenario, nullptr, scope, {}},
                                       some_path(scenario, scope), "timer.single-heartbeat");
  EXPECT_FALSE(outcome.counterexample);
  EXPECT_NE(outcome.why_not.find("does not object"), std::string::npos) << outcome.why_not;
}

TEST(Replay, APathThatTheSimulatorDoesNotTakeIsRefused) {
  const model::Scenario scenario = tiny_scenario();
  const Scope scope = tiny_scope();
  ConcretePath path = some_path(scenario, scope);
  path.packets.back().emitted += Nanoseconds{1};
  const ReplayOutcome outcome =
      replay({scenario, scenario, nullptr, scope, {}}, path, "storm.free-threshold");
  EXPECT_FALSE(outcome.counterexample);
  EXPECT_NE(outcome.why_not.find("in the simulator"), std::string::npos) << outcome.why_not;
}

}  // namespace path_test
}  // namespace stormproof::explorer
