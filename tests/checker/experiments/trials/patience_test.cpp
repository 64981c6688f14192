// How long a run may take, by what was seen before.
#include "checker/experiments/trials/patience.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace stormproof::trials {
namespace patience_test {

using model::Nanoseconds;

TEST(Patience, ALimitAloneCutsNothing) {
  Patience patience{Nanoseconds{1'000}};
  patience.see(1, beside_best);
  EXPECT_EQ(patience.limit(), Nanoseconds{1'000});
  EXPECT_FALSE(patience.may_cut());
  EXPECT_FALSE(patience.lengthen());
}

TEST(Patience, OnlyBecomesLess) {
  Patience patience{Nanoseconds{1'000}, Nanoseconds{100}};
  patience.see(200, beside_best);
  EXPECT_EQ(patience.limit(), Nanoseconds{800});
  patience.see(240, beside_best);
  EXPECT_EQ(patience.limit(), Nanoseconds{800});
  patience.see(10, beside_best);
  EXPECT_EQ(patience.limit(), Nanoseconds{100});
  EXPECT_FALSE(patience.may_cut());
  EXPECT_EQ(patience.whole(), Nanoseconds{1'000});
}

TEST(Patience, BeginsShortUntilSomethingCompletes) {
  Patience patience = Patience::from_least(Nanoseconds{1'000}, Nanoseconds{100});
  EXPECT_EQ(patience.limit(), Nanoseconds{100});
  EXPECT_TRUE(patience.may_cut());
  patience.see(std::numeric_limits<double>::infinity(), beside_best);
  ASSERT_TRUE(patience.lengthen());
  EXPECT_EQ(patience.limit(), Nanoseconds{200});
  // What completes late within that may have to be waited for longer than until now.
  patience.see(180, beside_best);
  EXPECT_EQ(patience.limit(), Nanoseconds{720});
  EXPECT_FALSE(patience.lengthen());
}

TEST(Patience, EndsWithTheLimitOfAllRuns) {
  Patience patience = Patience::from_least(Nanoseconds{300}, Nanoseconds{200});
  ASSERT_TRUE(patience.lengthen());
  EXPECT_EQ(patience.limit(), Nanoseconds{300});
  EXPECT_FALSE(patience.lengthen());
  patience.see(299, beside_best);
  EXPECT_EQ(patience.limit(), Nanoseconds{300});
}

}  // namespace patience_test
}  // namespace stormproof::trials
