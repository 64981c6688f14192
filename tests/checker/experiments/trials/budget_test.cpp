// A budget and its parts, by a clock that is set by hand.
#include "checker/experiments/trials/budget.hpp"

#include <gtest/gtest.h>

namespace stormproof::trials {
namespace budget_test {

TEST(Budget, WithoutAnEndNothingIsOver) {
  const Budget endless;
  EXPECT_FALSE(endless.is_limited());
  EXPECT_FALSE(endless.is_over());
  EXPECT_EQ(endless.used(), 0);
  EXPECT_FALSE(endless.part(0.1).is_limited());
  EXPECT_FALSE((Budget{[] { return std::optional<double>{}; }}.is_limited()));
}

TEST(Budget, APartEndsBeforeTheWhole) {
  double left = 100;
  const Budget whole{[&left] { return std::optional{left}; }};
  const Budget first = whole.part(0.25);
  EXPECT_DOUBLE_EQ(first.left(), 25);
  left = 90;
  EXPECT_DOUBLE_EQ(first.left(), 15);
  EXPECT_DOUBLE_EQ(first.used(), 0.4);
  EXPECT_DOUBLE_EQ(whole.used(), 0.1);
  const Budget of_first = first.part(0.5);
  EXPECT_DOUBLE_EQ(of_first.left(), 7.5);
  left = 75;
  EXPECT_TRUE(of_first.is_over());
  EXPECT_TRUE(first.is_over());
  EXPECT_FALSE(whole.is_over());
  EXPECT_EQ(first.used(), 1);
  // What comes later shares what is left.
  EXPECT_DOUBLE_EQ(whole.part(0.4).left(), 30);
  left = 0;
  EXPECT_TRUE(whole.is_over());
  EXPECT_EQ(whole.part(0.5).used(), 1);
}

TEST(Pace, SaysHowManyMoreFit) {
  double left = 100;
  const Budget whole{[&left] { return std::optional{left}; }};
  const Pace pace{whole, 5};
  left = 80;  // five runs in 20 s
  EXPECT_EQ(pace.fitting(whole, 10), 15U) << "three quarters of 20";
  EXPECT_EQ(pace.fitting(whole.part(0.5), 10), 7U);
  left = 0;
  EXPECT_EQ(pace.fitting(whole, 10), 1U);
  EXPECT_GE(pace.fitting(Budget{}, 10), 1'000'000U) << "as long as it takes";
}

}  // namespace budget_test
}  // namespace stormproof::trials
