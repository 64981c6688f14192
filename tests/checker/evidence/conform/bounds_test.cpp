// What bounds mean, to the nanosecond; where a check ends; and what is refused.
#include <gtest/gtest.h>

#include "tests/checker/evidence/conform/captures.hpp"
#include "tests/checker/evidence/conform/edits.hpp"

namespace stormproof::conform::testing {
namespace bounds_test {

constexpr std::int64_t ms = 1'000'000;
constexpr std::int64_t resolution = 1'000;  ///< of captures in microseconds, which is forgiven

bool is_multicast_of_0(const Conversation& c, const Event& event) {
  return event.is_multicast && source_of(c, event) == 0 &&
         event.traffic() == capture::Traffic::spdp;
}

class BoundsEffect : public ::testing::Test {
 protected:
  BoundsEffect() {
    scenario_.deployment = model::Deployment::homogeneous(2, 1, 2);
    scenario_.dds = profile("fastdds-2.6.11");
    scenario_.wireless.kind = model::ServiceKind::constant_delay;
    scenario_.wireless.one_way = model::Nanoseconds{ms};
    scenario_.time_limit = model::Nanoseconds{4'000 * ms};
    scenario_.run_until = model::RunUntil::time_limit;
  }
  Simulated run(std::vector<std::uint64_t> lost = {}) {
    scenario_.wireless.lost_packets = std::move(lost);
    return simulated(scenario_);
  }
  /// Moves the last multicast of participant 0, with its copies.
  static void delay_announcement(Conversation& c, std::int64_t by_ns) {
    const auto matches = [&c](const Event& event) { return is_multicast_of_0(c, event); };
    const std::int64_t time = c.events[find_last(c, matches)].time_ns;
    const auto moved = [&](const Event& event) {
      return event.time_ns == time && source_of(c, event) == 0 &&
             event.traffic() == capture::Traffic::spdp;
    };
    for (auto left = std::count_if(c.events.begin(), c.events.end(), moved); left > 0; --left) {
      move(c, find(c, moved), time + by_ns);
    }
  }
  model::Scenario scenario_;
};

TEST_F(BoundsEffect, LatenessAtTheBoundPassesAndALittleMoreDoesNot) {
  Simulated one = run();
  Bounds bounds = exact_bounds(scenario_, one);
  bounds.most_lateness_ns = 5 * ms;
  delay_announcement(one.conversation, 5 * ms);
  const Conformance at = conformance(one.conversation, scenario_.dds, bounds);
  EXPECT_TRUE(is_explained(at)) << description(at);
  EXPECT_EQ(at.used_lateness_ns, 5 * ms);

  one = run();
  delay_announcement(one.conversation, 5 * ms + resolution + 1);
  const Conformance beyond = conformance(one.conversation, scenario_.dds, bounds);
  ASSERT_EQ(beyond.verdict, Verdict::does_not_conform) << description(beyond);
  EXPECT_EQ(beyond.unexplained.front().fault, Fault::announcement_due);
  EXPECT_EQ(beyond.unexplained.front().needs.front().bound_ns, 5 * ms);
}

/// An announcement that is early by no more than the resolution is on time.
TEST_F(BoundsEffect, TheResolutionOfCapturesIsForgiven) {
  for (const bool is_within : {true, false}) {
    Simulated one = run();
    delay_announcement(one.conversation, is_within ? -resolution : -resolution - 1);
    const Conformance result =
        conformance(one.conversation, scenario_.dds, exact_bounds(scenario_, one));
    EXPECT_EQ(result.verdict, is_within ? Verdict::conforms : Verdict::does_not_conform)
        << description(result);
  }
}

/// Every packet takes 1 ms: that bound is enough, and less is not.
TEST_F(BoundsEffect, DelaysAreThoseOfTheRun) {
  const Simulated one = run();
  Bounds bounds = exact_bounds(scenario_, one);
  bounds.least_delay_ns = ms;
  bounds.most_delay_ns = ms;
  bounds.may_lose = false;
  const Conformance exact = conformance(one.conversation, scenario_.dds, bounds);
  EXPECT_TRUE(is_explained(exact)) << description(exact);
  bounds.least_delay_ns = ms / 2;
  bounds.most_delay_ns = ms / 2;
  EXPECT_EQ(conformance(one.conversation, scenario_.dds, bounds).verdict,
            Verdict::does_not_conform);
}

/// The HEARTBEAT that opens the relation is lost, and the answer to the initial ACKNACK is not: the
/// reply answers that one, although the lost one would fit it but for its age.
TEST_F(BoundsEffect, AHeartbeatThatIsTooOldIsLost) {
  const auto lost = [this] {
    const Simulated whole = run();
    const auto& events = whole.conversation.events;
    return std::uint64_t{events[find(whole.conversation, [](const Event& event) {
                           return event.heartbeat() != nullptr &&
                                  event.traffic() == capture::Traffic::sedp;
                         })].datagram};
  }();
  const Simulated one = run({lost});
  Bounds bounds = exact_bounds(scenario_, one);
  bounds.most_delay_ns = 2 * ms;
  const Conformance result = conformance(one.conversation, scenario_.dds, bounds);
  EXPECT_TRUE(is_explained(result)) << description(result);
  EXPECT_TRUE(std::any_of(result.hidden.begin(), result.hidden.end(), [](const Hidden& event) {
    return event.kind == Hidden::Kind::lost || event.kind == Hidden::Kind::dropped;
  }));
}

TEST_F(BoundsEffect, LossesExplainOnlyIfTheyAreAdmitted) {
  Simulated one = run();
  Conversation& c = one.conversation;
  drop(c, find_last(c, [](const Event& event) {
         return event.acknack() != nullptr && event.traffic() == capture::Traffic::sedp;
       }));
  Bounds bounds = exact_bounds(scenario_, one);
  bounds.most_delay_ns = 2 * ms;
  bounds.may_lose = true;
  EXPECT_TRUE(is_explained(conformance(c, scenario_.dds, bounds)));
  bounds.may_lose = false;
  const Conformance result = conformance(c, scenario_.dds, bounds);
  ASSERT_EQ(result.verdict, Verdict::does_not_conform);
  EXPECT_EQ(result.unexplained.front().fault, Fault::unanswered);
}

TEST_F(BoundsEffect, EventsAfterTheEndAreNotLookedAt) {
  Simulated one = run();
  Conversation& c = one.conversation;
  const Event last = c.events.back();
  const std::size_t added = add(c, last, last.time_ns + ms);
  const Bounds bounds = exact_bounds(scenario_, one);
  EXPECT_EQ(conformance(c, scenario_.dds, bounds).verdict, Verdict::does_not_conform);
  Request request{.conversation = c, .dds = scenario_.dds, .bounds = bounds};
  request.until_ns = c.events[added].time_ns - 1;
  const auto cut = conform(request);
  ASSERT_TRUE(cut);
  EXPECT_TRUE(is_explained(*cut)) << description(*cut);
}

TEST_F(BoundsEffect, WhatFollowsTheFirstThatLeavesIsNotLookedAt) {
  Simulated one = run();
  Conversation& c = one.conversation;
  const Event last = c.events.back();
  Event goodbye = c.events.front();
  ASSERT_NE(goodbye.data(), nullptr);
  capture::DataEvent content = *goodbye.data();
  content.is_gone = true;
  goodbye.content = content;
  add(c, goodbye, last.time_ns + ms);
  add(c, last, last.time_ns + 2 * ms);
  const Conformance result = conformance(c, scenario_.dds, exact_bounds(scenario_, one));
  EXPECT_TRUE(is_explained(result)) << description(result);
  bool is_said = false;
  for (const std::string& text : result.assumptions) {
    is_said = is_said || text.find("leaves") != std::string::npos;
  }
  EXPECT_TRUE(is_said);
}

TEST_F(BoundsEffect, AnInterruptedCheckIsInconclusive) {
  const Simulated one = run();
  Request request{.conversation = one.conversation,
                  .dds = scenario_.dds,
                  .bounds = exact_bounds(scenario_, one)};
  std::size_t calls = 0;
  request.progress = [&calls](std::size_t done, std::size_t all) {
    EXPECT_LT(done, all);
    return ++calls < 3;
  };
  const auto result = conform(request);
  ASSERT_TRUE(result);
  EXPECT_EQ(calls, 3U);
  EXPECT_EQ(result->verdict, Verdict::inconclusive);
  EXPECT_EQ(result->why_inconclusive, "interrupted");
  EXPECT_LT(result->explained, result->checked);
}

TEST_F(BoundsEffect, RowsOfTheMachinesAreCounted) {
  const Simulated one = run();
  const Conformance result =
      conformance(one.conversation, scenario_.dds, exact_bounds(scenario_, one));
  std::uint64_t serialized = 0;
  for (const RowUse& row : result.rows) {
    if (row.text.starts_with("Q + Serialized")) serialized = row.times;
  }
  const auto count = [&](Rule rule) { return result.by_rule[static_cast<std::size_t>(rule)]; };
  EXPECT_EQ(serialized, count(Rule::data_push) + count(Rule::data_pull));
  EXPECT_EQ(serialized, static_cast<std::uint64_t>(one.run.counts.initial_data));
  EXPECT_EQ(count(Rule::data_repair), static_cast<std::uint64_t>(one.run.counts.repair_data));
  EXPECT_EQ(count(Rule::acknack_reply) + count(Rule::acknack_initial),
            static_cast<std::uint64_t>(one.run.counts.acknack));
}

/// The capture of each host alone is half of the conversation; both together are all of it.
TEST_F(BoundsEffect, NeitherOneHostNorThePapersWriterCanBeChecked) {
  const Simulated one = run();
  const Bounds bounds = exact_bounds(scenario_, one);
  const auto paper =
      conform({.conversation = one.conversation, .dds = profile("paper"), .bounds = bounds});
  ASSERT_FALSE(paper);
  EXPECT_NE(to_string(paper.error()).find("implementation: fastdds"), std::string::npos);

  Conversation alone = one.conversation;
  alone.topology.hosts = 1;
  const auto refused = conform({.conversation = alone, .dds = scenario_.dds, .bounds = bounds});
  ASSERT_FALSE(refused);
  EXPECT_NE(to_string(refused.error()).find("one host"), std::string::npos);
}

}  // namespace bounds_test
}  // namespace stormproof::conform::testing
