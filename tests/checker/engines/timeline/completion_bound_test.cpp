// B in numbers, by hand.
#include "checker/engines/bounds/completion_bound.hpp"

#include <gtest/gtest.h>

namespace stormproof::timeline {
namespace completion_bound_test {

using model::Nanoseconds;

constexpr Nanoseconds ms(std::int64_t count) { return Nanoseconds{count * 1'000'000}; }

TEST(CompletionBound, PaperProfile) {
  const model::SedpProfile paper;  // τ_A 10 µs, τ_N 100 µs, τ_S 10 µs, τ_H 1 s
  EXPECT_EQ(completion_bound(paper, 0, ms(1)), ms(1));
  EXPECT_EQ(completion_bound(paper, 1, ms(1)), Nanoseconds{3'110'000});
  // W = 3Δ + τ_N + τ_S = 3.11 ms, so s = 0.
  EXPECT_EQ(completion_bound(paper, 2, ms(1)), Nanoseconds{1'006'220'000});
  EXPECT_EQ(completion_bound(paper, 3, ms(1)), Nanoseconds{2'006'220'000});
  EXPECT_EQ(completion_bound(paper, 3, ms(400)), Nanoseconds{5'400'220'000});  // s = 1
}

TEST(CompletionBound, TimerThatStartsWithTheRelation) {
  const model::DdsProfile paper;
  Circumstances c{ms(400), Nanoseconds{0}, true, {}};
  auto bound = completion_bound(paper, c);
  ASSERT_TRUE(bound);
  EXPECT_EQ(bound->spoilt, 0);  // W = 800.11 ms
  EXPECT_EQ(bound->after(3), Nanoseconds{1'200'110'000} + ms(2'000));
  c.delta = ms(500);
  bound = completion_bound(paper, c);
  EXPECT_EQ(bound->spoilt, 1);  // W = 1000.11 ms: a lost repair costs two periods
  EXPECT_EQ(bound->after(3), Nanoseconds{1'500'110'000} + ms(4'000));
}

TEST(CompletionBound, PulledDataCostsOneExchangeMore) {
  model::SedpProfile pull;
  pull.initial_data = model::InitialData::pull;
  const model::SedpProfile push;
  for (unsigned k = 0; k < 5; ++k) {
    EXPECT_EQ(completion_bound(pull, k, ms(7)), completion_bound(push, k + 1, ms(7)));
  }
}

TEST(CompletionBound, GrowsWithLossesAndDelay) {
  const model::SedpProfile paper;
  for (unsigned k = 0; k < 20; ++k) {
    for (const std::int64_t delay : {0, 1, 10, 333, 334, 1'000}) {
      EXPECT_LE(completion_bound(paper, k, ms(delay)), completion_bound(paper, k + 1, ms(delay)));
      EXPECT_LT(completion_bound(paper, k, ms(delay)), completion_bound(paper, k, ms(delay + 1)));
    }
  }
}

TEST(CompletionBound, OutsideTheRegion) {
  model::SedpProfile adaptive;
  adaptive.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  EXPECT_FALSE(completion_bound(adaptive, 1, ms(1)));
  const model::SedpProfile paper;
  EXPECT_FALSE(completion_bound(paper, 1, Nanoseconds{-1}));
  EXPECT_FALSE(completion_bound(paper, 1, ms(40'000'000'000)));
  EXPECT_TRUE(completion_bound(paper, 4'000'000'000U, ms(1)));
  EXPECT_FALSE(completion_bound(paper, 4'000'000'000U, ms(10'000)));  // more than a time can hold
}

TEST(CompletionBound, FastDds) {
  model::DdsProfile fastdds;
  fastdds.implementation = model::ImplementationKind::fastdds;
  const auto bound = completion_bound(fastdds, {ms(1), std::nullopt, false, {}});
  ASSERT_TRUE(bound);
  EXPECT_EQ(bound->after(0), Nanoseconds{1'003'120'000});
  EXPECT_EQ(bound->after(2), Nanoseconds{1'003'120'000} + Nanoseconds{1'002'120'000} * 2);
}

}  // namespace completion_bound_test
}  // namespace stormproof::timeline
