// The reader side against brute force: tiny relations with all ways to lose datagrams, and all
// instants at which each ACKNACK can be generated. A reply is explained exactly if some way makes a
// reader say it.
#include <gtest/gtest.h>

#include "checker/evidence/conform/reply_search.hpp"
#include "props/generators/dice.hpp"

namespace stormproof::conform {
namespace replies_test {

constexpr std::int64_t ms = 1'000'000;

/// Submessages are 10 ms apart, and so are ACKNACKs, in between: when each is generated is free, as
/// delays have no bound that matters.
struct Puzzle {
  Relation relation{};
  std::vector<const Answer*> replies() const {
    std::vector<const Answer*> list;
    for (const Answer& answer : relation.answers) list.push_back(&answer);
    return list;
  }
};

void add_submessage(Puzzle& puzzle, props::Dice& dice, std::int64_t time, std::uint32_t& count,
                    std::uint32_t datagram) {
  Submessage one{time, puzzle.relation.sent.size(), datagram, {}, {}};
  if (dice.chance(50)) {
    one.descriptor = dice.count(0, 2);
  } else {
    one.heartbeat = Heartbeat{1, dice.count(1, 3), ++count, true, false};
  }
  puzzle.relation.sent.push_back(one);
}

Puzzle draw(std::uint64_t seed) {
  props::Dice dice{seed};
  Puzzle puzzle;
  std::uint32_t count = 0;
  std::uint32_t datagram = 0;
  std::int64_t time = 0;
  const std::int64_t submessages = dice.between(1, 6);
  for (std::int64_t k = 0; k < submessages; ++k) {
    if (k == 0 || dice.chance(70)) {
      ++datagram;
      time += 10 * ms;
    }
    add_submessage(puzzle, dice, time, count, datagram);
  }
  std::int64_t answered = 0;
  for (std::int64_t k = dice.between(1, 3); k > 0; --k) {
    Answer answer;
    answered = std::max(answered + 10 * ms, 10 * dice.between(1, 7) * ms + 5 * ms);
    answer.time_ns = answered;
    answer.base = dice.count(0, 3);
    for (std::uint32_t d = answer.base; d < 3; ++d) {
      if (dice.chance(60)) answer.missing.push_back(d);
    }
    puzzle.relation.answers.push_back(answer);
  }
  return puzzle;
}

/// What a reader that knows `knowledge` says.
bool says(const Knowledge& knowledge, const Answer& answer) {
  if (knowledge.base() != answer.base) return false;
  for (std::uint32_t d = answer.base; d < 3; ++d) {
    const bool is_missing = d < knowledge.announced && !knowledge.knows(d);
    if (is_missing != answer.asks_for(d)) return false;
  }
  return true;
}

/// All ways: submessage `next` arrives or its datagram is lost, or the reader replies now. The
/// sets of lost datagrams are `lost`, one bit for each.
bool goes_on(const Puzzle& puzzle, std::uint32_t lost, std::size_t next, std::size_t reply,
             const Knowledge& knowledge, bool has_pending) {
  if (reply == puzzle.relation.answers.size()) return true;
  const Answer& answer = puzzle.relation.answers[reply];
  if (has_pending && says(knowledge, answer) &&
      goes_on(puzzle, lost, next, reply + 1, knowledge, false)) {
    return true;
  }
  if (next == puzzle.relation.sent.size()) return false;
  const Submessage& one = puzzle.relation.sent[next];
  if (one.time_ns > answer.time_ns) return false;  // not sent yet
  if ((lost >> one.datagram & 1U) != 0) {
    return goes_on(puzzle, lost, next + 1, reply, knowledge, has_pending);
  }
  Knowledge after = knowledge;
  const bool is_accepted = after.take(one);
  return goes_on(puzzle, lost, next + 1, reply, after, has_pending || is_accepted);
}

bool brute_force(const Puzzle& puzzle, bool may_lose) {
  const std::uint32_t datagrams = puzzle.relation.sent.back().datagram + 1;
  for (std::uint32_t lost = 0; lost < (may_lose ? 1U << datagrams : 1U); lost += 2) {
    if (goes_on(puzzle, lost, 0, 0, {}, false)) return true;
  }
  return false;
}

bool search(const Puzzle& puzzle, bool may_lose) {
  model::SedpProfile sedp;
  sedp.heartbeat_response_delay = model::Nanoseconds{0};
  Bounds bounds;
  bounds.most_send_lag_ns = 0;
  bounds.most_lateness_ns = 0;
  bounds.may_lose = may_lose;
  const auto replies = puzzle.replies();
  const ReplySearch result = search_replies(puzzle.relation, replies, sedp, bounds);
  EXPECT_NE(result.kind, ReplySearch::Kind::given_up);
  return result.kind == ReplySearch::Kind::explained;
}

TEST(Replies, AreExplainedIfSomeWayExplainsThem) {
  std::size_t explained = 0;
  std::size_t not_explained = 0;
  for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
    const Puzzle puzzle = draw(seed);
    const bool is_possible = brute_force(puzzle, true);
    EXPECT_EQ(search(puzzle, true), is_possible) << "seed " << seed;
    ++(is_possible ? explained : not_explained);
    if (HasFailure()) return;
  }
  EXPECT_GT(explained, 500U);
  EXPECT_GT(not_explained, 100U);
}

/// Without losses the reader of these puzzles is open from the start, too: nothing is dropped.
TEST(Replies, WithoutLossesEverythingArrives) {
  std::size_t only_with_losses = 0;
  for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
    const Puzzle puzzle = draw(seed);
    if (brute_force(puzzle, false)) {
      EXPECT_TRUE(search(puzzle, false)) << "seed " << seed;
    } else if (brute_force(puzzle, true)) {
      ++only_with_losses;
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(only_with_losses, 100U);
}

}  // namespace replies_test
}  // namespace stormproof::conform
