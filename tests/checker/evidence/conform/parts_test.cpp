// Small parts: sorting a conversation into relations, what a reader learns from a submessage, when
// timers fired, ways to tell what was sent, and the words for ACKNACKs.
#include <gtest/gtest.h>

#include "checker/evidence/conform/arrivals.hpp"
#include "checker/evidence/conform/timers.hpp"
#include "checker/evidence/conform/ways.hpp"
#include "checker/evidence/conform/words.hpp"
#include "tests/checker/evidence/conform/captures.hpp"
#include "tests/checker/evidence/conform/edits.hpp"

namespace stormproof::conform::testing {
namespace parts_test {

Submessage data(std::uint32_t descriptor, std::uint32_t datagram = 1) {
  return {0, 0, datagram, descriptor, {}};
}
Submessage heartbeat(std::uint32_t announced, std::uint32_t count, std::uint32_t datagram = 1) {
  return {0, 0, datagram, {}, Heartbeat{1, announced, count, true, false}};
}

TEST(Knowledge, GrowsWithDataAndHeartbeats) {
  Knowledge knowledge;
  EXPECT_EQ(knowledge.base(), 0U);
  EXPECT_FALSE(knowledge.take(data(2)));
  EXPECT_EQ(knowledge.announced, 3U);
  EXPECT_EQ(knowledge.base(), 0U);
  EXPECT_TRUE(knowledge.take(heartbeat(5, 7)));
  EXPECT_EQ(knowledge.announced, 5U);
  EXPECT_FALSE(knowledge.take(data(0)));
  EXPECT_EQ(knowledge.base(), 1U);
  EXPECT_TRUE(knowledge.knows(2));
  EXPECT_FALSE(knowledge.knows(1));
  EXPECT_FALSE(knowledge.knows(99));
}

TEST(Knowledge, AcceptsOnlyLaterHeartbeats) {
  Knowledge knowledge;
  EXPECT_TRUE(knowledge.take(heartbeat(2, 7)));
  EXPECT_FALSE(knowledge.take(heartbeat(9, 7)));
  EXPECT_FALSE(knowledge.take(heartbeat(9, 6)));
  EXPECT_EQ(knowledge.announced, 2U);
  EXPECT_TRUE(knowledge.take(heartbeat(3, 8)));
  EXPECT_EQ(knowledge.announced, 3U);
}

/// A datagram is lost as a whole; when a part of it has arrived, the rest does.
TEST(ArrivalsFor, DatagramsAreLostAsAWhole) {
  const Answer asks{0, 0, 0, {0}, false};
  const std::vector<Submessage> apart{data(0, 1), heartbeat(1, 1, 2)};
  const Arrivals lost = arrivals_for(asks, {}, apart);
  EXPECT_EQ(lost.mismatch, "");
  EXPECT_EQ(lost.arrived, (std::vector<bool>{false, true}));
  const std::vector<Submessage> together{data(0, 1), heartbeat(1, 1, 1)};
  EXPECT_NE(arrivals_for(asks, {}, together).mismatch, "");
  Knowledge begun;
  begun.take(heartbeat(1, 1, 1));
  const std::vector<Submessage> rest{data(0, 1)};
  EXPECT_NE(arrivals_for(asks, begun, rest).mismatch, "");
}

/// What is announced by the rest of a datagram cannot be taken back either: the search ends.
TEST(ArrivalsFor, TheRestOfADatagramAnnounces) {
  Knowledge begun;
  begun.take(heartbeat(1, 1, 1));
  const std::vector<Submessage> rest{heartbeat(3, 2, 1)};
  const Answer too_little{0, 0, 0, {0}, false};
  EXPECT_NE(arrivals_for(too_little, begun, rest).mismatch, "");
  const Answer enough{0, 0, 0, {0, 1, 2}, false};
  EXPECT_EQ(arrivals_for(enough, begun, rest).mismatch, "");
}

TEST(Words, DescribeAcknacks) {
  EXPECT_EQ(words({0, 0, 5, {5, 6, 7, 12}, false}), "base 5, asks for 5–7, 12");
  EXPECT_EQ(words({0, 0, 9, {}, false}), "base 9, asks for nothing");
  EXPECT_EQ(words({0, 0, 0, {}, true}), "base 0, initial");
}

TEST(Words, ContextIsNearTheEventAndHoldsItsCause) {
  Relation relation;
  for (std::size_t k = 0; k < 40; ++k) relation.sent.push_back({0, k, 0, 0U, {}});
  const auto context = context_of(relation, 20, 1);
  EXPECT_EQ(context.front(), 1U);
  EXPECT_EQ(context.size(), 14U);
  EXPECT_TRUE(std::is_sorted(context.begin(), context.end()));
  EXPECT_EQ(std::count(context.begin(), context.end(), 20U), 1);
}

class Sorting : public ::testing::Test {
 protected:
  Sorting() {
    model::Scenario scenario;
    scenario.deployment = model::Deployment::homogeneous(2, 2, 1);
    scenario.dds = profile("fastdds-2.6.11");
    conversation_ = simulated(scenario).conversation;
  }
  capture::Conversation conversation_;
};

TEST_F(Sorting, EveryEventIsInOnePlace) {
  const Dialogue dialogue = sort_out(conversation_, INT64_MAX);
  std::size_t events = 0;
  for (const Relation& relation : dialogue.relations) {
    events += relation.sent.size() + relation.answers.size();
    EXPECT_TRUE(
        std::is_sorted(relation.sent.begin(), relation.sent.end(),
                       [](const Submessage& a, const Submessage& b) { return a.event < b.event; }));
  }
  for (const auto& announcements : dialogue.announcements) events += announcements.size();
  EXPECT_EQ(events, dialogue.checked);
  EXPECT_EQ(dialogue.checked + dialogue.not_checked, conversation_.events.size());
  EXPECT_TRUE(dialogue.strange.empty());
  EXPECT_EQ(dialogue.has_neighbour, (std::vector<bool>{true, true, true, true}));
}

/// HEARTBEATs go to all readers of a writer, so its relations have to be found together.
TEST_F(Sorting, RelationsOfAWriterAreInARow) {
  const Dialogue dialogue = sort_out(conversation_, INT64_MAX);
  std::vector<std::pair<std::size_t, capture::EntityId>> writers;
  for (const Relation& relation : dialogue.relations) {
    const std::pair writer{relation.place.source, relation.place.writer};
    if (!writers.empty() && writers.back() == writer) continue;
    EXPECT_EQ(std::count(writers.begin(), writers.end(), writer), 0);
    writers.push_back(writer);
  }
  EXPECT_EQ(writers.size(), 8U);
  EXPECT_EQ(dialogue.relations.size(), 16U);
}

TEST_F(Sorting, SameHostAndUnknownDestinationsAreNotChecked) {
  const Dialogue before = sort_out(conversation_, INT64_MAX);
  const auto unicast = [](const Event& event) {
    return !event.is_multicast && event.traffic() == capture::Traffic::sedp;
  };
  conversation_.events[find(conversation_, unicast, 3)].is_same_host = true;
  conversation_.events[find(conversation_, unicast, 7)].destination.reset();
  const Dialogue after = sort_out(conversation_, INT64_MAX);
  EXPECT_EQ(after.checked + 2, before.checked);
  EXPECT_EQ(after.not_checked, before.not_checked + 2);
}

TEST_F(Sorting, WhatNothingSendsIsStrange) {
  const auto data_to_one = [](const Event& event) {
    return event.data() != nullptr && event.traffic() == capture::Traffic::sedp;
  };
  const std::size_t fragment = find(conversation_, data_to_one, 0);
  std::get<capture::DataEvent>(conversation_.events[fragment].content).fragment = 1;
  const std::size_t multicast = find(conversation_, data_to_one, 2);
  conversation_.events[multicast].is_multicast = true;
  conversation_.events[multicast].destination.reset();
  EXPECT_EQ(sort_out(conversation_, INT64_MAX).strange,
            (std::vector<std::size_t>{fragment, multicast}));
}

TEST_F(Sorting, EndsAtTheInstantGiven) {
  const std::int64_t middle = conversation_.events[conversation_.events.size() / 2].time_ns;
  const Dialogue half = sort_out(conversation_, middle);
  EXPECT_EQ(half.end_ns, middle);
  EXPECT_LT(half.checked, sort_out(conversation_, INT64_MAX).checked);
  for (const Relation& relation : half.relations) {
    for (const Submessage& one : relation.sent) EXPECT_LE(one.time_ns, middle);
  }
}

TEST_F(Sorting, KnowsTheLastSignOfAParticipant) {
  const Dialogue all = sort_out(conversation_, INT64_MAX);
  for (std::size_t i = 0; i < all.participants(); ++i) {
    const auto last = all.last_sign_of(i);
    ASSERT_TRUE(last);
    const auto& self = conversation_.topology.participants[i].prefix;
    EXPECT_EQ(conversation_.events[last->event].source, self);
    for (std::size_t k = last->event + 1; k < conversation_.events.size(); ++k) {
      EXPECT_NE(conversation_.events[k].source, self);
    }
  }
}

TEST(Timers, FireWhenTheyAreDueOrLateAndWhatTheySendIsCapturedBehind) {
  Bounds bounds;
  bounds.most_send_lag_ns = 10'000;
  bounds.most_lateness_ns = 50'000;
  const Window due{100'000, 120'000};
  const auto when = [&](std::int64_t captured_ns) {
    const auto at = fired(bounds, due, sent_in(bounds, captured_ns));
    return at ? std::vector{at->from_ns, at->to_ns} : std::vector<std::int64_t>{};
  };
  EXPECT_EQ(when(98'999), (std::vector<std::int64_t>{}));
  EXPECT_EQ(when(99'000), (std::vector<std::int64_t>{100'000, 100'000}));
  EXPECT_EQ(when(115'000), (std::vector<std::int64_t>{105'000, 116'000}));
  EXPECT_EQ(when(180'000), (std::vector<std::int64_t>{170'000, 170'000}));
  EXPECT_EQ(when(180'001), (std::vector<std::int64_t>{}));
  EXPECT_FALSE(is_overdue(bounds, due, 180'000));
  EXPECT_TRUE(is_overdue(bounds, due, 180'001));
}

/// Whichever of two comes first.
TEST(Ways, KeepOnlyThoseThatNoOtherIsAsGoodAs) {
  const Telling better{5, {0, 1}};
  const Telling worse{5, {1, 1}};
  const Telling other{4, {2, 0}};
  const auto next = [](const std::vector<Telling>& ways) {
    std::vector<std::vector<std::size_t>> answered;
    for (const Telling& way : best(ways)) answered.push_back(way.answered);
    return answered;
  };
  const std::vector<std::vector<std::size_t>> both{{0, 1}, {2, 0}};
  EXPECT_EQ(next({better, worse, other}), both);
  EXPECT_EQ(next({worse, better, other}), both);
  EXPECT_EQ(next({better, better}), (std::vector<std::vector<std::size_t>>{{0, 1}}));
  EXPECT_EQ(earliest(std::vector{better, other}), 4);
}

TEST(Ways, AnswerEachAckNackOnce) {
  std::vector<Telling> next;
  EXPECT_FALSE(answer(std::vector<Telling>{{0, {2}}}, 0, 2, next));
  EXPECT_TRUE(answer(std::vector<Telling>{{0, {2}}, {0, {1}}}, 0, 2, next));
  ASSERT_EQ(next.size(), 1U);
  EXPECT_EQ(next.front().answered, std::vector<std::size_t>{2});
}

}  // namespace parts_test
}  // namespace stormproof::conform::testing
