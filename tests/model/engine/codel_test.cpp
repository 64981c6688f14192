// CoDel on cases worked out by hand from RFC 8289, to the nanosecond.
#include "model/engine/codel.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace stormproof::model {
namespace codel_test {

constexpr std::int64_t ms = 1'000'000;
constexpr CoDel::Limits limits{5 * ms, 100 * ms, 1'538};

/// A line of frames of 1,000 bytes that are numbered from 0, and what becomes of them.
struct Bed {
  CoDel codel;
  FrameLine line;
  std::vector<std::uint64_t> dropped;
  std::uint64_t next_number = 0;

  void arrive(std::int64_t at_ns, int frames) {
    for (int k = 0; k < frames; ++k) {
      line.push({next_number++, 0, 0, 1'000, Nanoseconds{at_ns}});
    }
  }
  /// The number of the frame that is taken at that time.
  std::uint64_t take(std::int64_t at_ns) {
    return codel
        .next(limits, Nanoseconds{at_ns}, line,
              [&](const Frame& frame) { dropped.push_back(frame.number); })
        .number;
  }
};

using Numbers = std::vector<std::uint64_t>;

TEST(CoDel, DropsComeCloserByTheSquareRootOfTheirCount) {
  EXPECT_EQ(codel_spacing_ns(100 * ms, 1), 100'000'000);
  EXPECT_EQ(codel_spacing_ns(100 * ms, 2), 70'710'678);
  EXPECT_EQ(codel_spacing_ns(100 * ms, 3), 57'735'026);
  EXPECT_EQ(codel_spacing_ns(100 * ms, 4), 50'000'000);
  EXPECT_EQ(codel_spacing_ns(100 * ms, 10), 31'622'776);
  EXPECT_EQ(codel_spacing_ns(1, 2), 0);
  EXPECT_EQ(codel_spacing_ns(1'000'000'000'000'000, 4), 500'000'000'000'000);
}

TEST(CoDel, DropsOnceFramesHaveWaitedForTheTargetForAnInterval) {
  Bed bed;
  bed.arrive(0, 30);
  EXPECT_EQ(bed.take(5 * ms - 1), 0U);  // waited for less than the target
  EXPECT_EQ(bed.take(5 * ms), 1U);      // from now on for the target or longer
  EXPECT_EQ(bed.take(105 * ms - 1), 2U);
  EXPECT_EQ(bed.dropped, Numbers{});
  EXPECT_EQ(bed.take(105 * ms), 4U);
  EXPECT_EQ(bed.dropped, Numbers{3});
}

TEST(CoDel, GoesOnDroppingByTheControlLaw) {
  Bed bed;
  bed.arrive(0, 30);
  bed.take(5 * ms);
  bed.take(105 * ms);  // drops 1; the next one is due at 205 ms
  EXPECT_EQ(bed.take(205 * ms - 1), 3U);
  EXPECT_EQ(bed.take(205 * ms), 5U);  // drops 4; due at 275.710678 ms
  EXPECT_EQ(bed.take(275'710'677), 6U);
  EXPECT_EQ(bed.take(275'710'678), 8U);  // drops 7; due at 333.445704 ms
  EXPECT_EQ(bed.take(333'445'703), 9U);
  // Due at 333.445704, 383.445704, 428.167063 and 468.991892 ms, then at 506.788339 ms.
  EXPECT_EQ(bed.take(500 * ms), 14U);
  EXPECT_EQ(bed.dropped, (Numbers{1, 4, 7, 10, 11, 12, 13}));
  EXPECT_EQ(bed.take(506'788'338), 15U);
  EXPECT_EQ(bed.take(506'788'339), 17U);
}

/// Until 506.788339 ms it has dropped 8, and it has 15 frames more of that time.
Bed after_a_storm() {
  Bed bed;
  bed.arrive(0, 17);
  bed.take(5 * ms);
  bed.take(105 * ms);
  bed.take(205 * ms);
  bed.take(275'710'678);
  bed.take(500 * ms);  // seven dropped: the count is 7, the next one would be due at 506.788339 ms
  EXPECT_EQ(bed.dropped.size(), 7U);
  while (!bed.line.empty()) bed.take(501 * ms);  // the last ones are few
  return bed;
}

TEST(CoDel, TakesUpTheCountSoonAfterTheLastTime) {
  Bed bed = after_a_storm();
  const std::uint64_t first = bed.next_number;
  bed.dropped.clear();
  bed.arrive(600 * ms, 30);
  EXPECT_EQ(bed.take(610 * ms), first);
  EXPECT_EQ(bed.take(710 * ms), first + 2);  // 7 before, of which the first was 1: goes on with 6
  EXPECT_EQ(bed.take(750'824'828), first + 3);
  EXPECT_EQ(bed.take(750'824'829), first + 5);  // 100 ms / √6 later
  EXPECT_EQ(bed.dropped, (Numbers{first + 1, first + 4}));
}

TEST(CoDel, BeginsAnewLongAfterTheLastTime) {
  Bed bed = after_a_storm();
  const std::uint64_t first = bed.next_number;
  const std::int64_t late = 506'788'339 + 1'600 * ms;  // 16 intervals after the next drop
  bed.arrive(late - 110 * ms, 30);
  EXPECT_EQ(bed.take(late - 100 * ms), first);
  EXPECT_EQ(bed.take(late), first + 2);
  EXPECT_EQ(bed.take(late + 100 * ms - 1), first + 3);
  EXPECT_EQ(bed.take(late + 100 * ms), first + 5);
}

TEST(CoDel, OneFrameThatWaitedForLessEndsIt) {
  Bed bed;
  bed.arrive(0, 4);
  bed.arrive(103 * ms, 20);
  bed.take(5 * ms);
  EXPECT_EQ(bed.take(105 * ms), 2U);  // drops 1
  EXPECT_EQ(bed.take(106 * ms), 3U);
  EXPECT_EQ(bed.take(107 * ms), 4U);  // waited for 4 ms
  EXPECT_EQ(bed.take(205 * ms), 5U);  // would be due, but an interval begins
  EXPECT_EQ(bed.take(305 * ms - 1), 6U);
  EXPECT_EQ(bed.take(305 * ms), 8U);
  EXPECT_EQ(bed.dropped, (Numbers{1, 7}));
}

TEST(CoDel, WhatIsAtMostAFullFrameMayWaitForEver) {
  Bed bed;
  bed.arrive(0, 4);
  bed.take(5 * ms);
  EXPECT_EQ(bed.take(105 * ms), 2U);  // 2,000 bytes would be left: dropped; 1,000 are: kept
  EXPECT_EQ(bed.take(5'000 * ms), 3U);
  EXPECT_EQ(bed.dropped, Numbers{1});
}

}  // namespace codel_test
}  // namespace stormproof::model
