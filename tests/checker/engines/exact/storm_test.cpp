// One definition of a storm, by what was sent until discovery was complete.
#include "checker/engines/exact/storm.hpp"

#include <gtest/gtest.h>

namespace stormproof::exact {
namespace storm_test {

/// 100 first sendings, as many needless repeats as `repeats`, no control.
Sent repeated(double repeats) {
  Sent sent;
  sent.initial_data = 100;
  sent.repair_data = repeats;
  sent.needed_repairs = 0;
  return sent;
}

model::Limits limits(std::int64_t numerator, std::int64_t seconds) {
  model::Limits all;
  all.needless = model::Ratio{numerator, 1};
  all.late = model::Nanoseconds{seconds * 1'000'000'000};
  return all;
}

TEST(Storm, TakesMoreThanEverythingSentOnceAndIsLate) {
  EXPECT_TRUE(is_storm(expense_of(repeated(101), true), {}));
  EXPECT_FALSE(is_storm(expense_of(repeated(100), true), {})) << "as much as, and not more";
  EXPECT_FALSE(is_storm(expense_of(repeated(10'000), false), {})) << "repeats that do not decide";
}

TEST(Storm, TakesANeedlessRepeat) {
  Sent sent = repeated(0);
  sent.heartbeats = {10'000, 0.01};
  sent.acknacks = {10'000, 0.01};
  EXPECT_FALSE(is_storm(expense_of(sent, true), {})) << "control traffic alone";
  sent = repeated(1'000);
  sent.needed_repairs = 0.95;
  EXPECT_FALSE(is_storm(expense_of(sent, true), {})) << "repairs of what was lost";
}

TEST(Storm, ControlTrafficIsSharedOutAmongFirstSendingsAndRepeats) {
  Sent sent = repeated(100);
  sent.heartbeats = {120, 20.0 / 120};
  const Expense took = expense_of(sent, true);
  EXPECT_DOUBLE_EQ(took.once, 120);
  EXPECT_DOUBLE_EQ(took.needless, 150) << "half of the 100 HEARTBEATs beyond what is needed";
}

TEST(Storm, UserControlIsSentOnce) {
  Sent sent = repeated(150);
  sent.user_control = 60;
  EXPECT_FALSE(is_storm(expense_of(sent, true), {}));
}

TEST(Storm, DiscoveryNeedsNoLookupsOfTypes) {
  Sent sent = repeated(0);
  sent.lookups = 500;
  const Expense took = expense_of(sent, true);
  EXPECT_DOUBLE_EQ(took.once, 100);
  EXPECT_DOUBLE_EQ(took.needless, 500);
}

TEST(Storm, BothNumbersAreLimitsOfTheScenario) {
  EXPECT_EQ(late_limit({}), model::Nanoseconds{1'000'000'000});
  EXPECT_EQ(late_limit(limits(2, 3)), model::Nanoseconds{3'000'000'000});
  EXPECT_FALSE(is_storm(expense_of(repeated(150), true), limits(2, 3)));
  EXPECT_TRUE(is_storm(expense_of(repeated(201), true), limits(2, 3)));
  const std::string words = storm_definition(limits(2, 3));
  EXPECT_NE(words.find("more than 2.00 × the airtime"), std::string::npos) << words;
  EXPECT_NE(words.find("longer than 3.000 s"), std::string::npos) << words;
}

TEST(Storm, FromTwiceTheMessagesOnItIsAmplified) {
  EXPECT_TRUE(is_amplified(2.95));
  EXPECT_FALSE(is_amplified(2));
}

TEST(Storm, OfNothingNothingIsNeedless) {
  EXPECT_DOUBLE_EQ(expense_of({}, true).ratio(), 0);
  EXPECT_FALSE(is_storm(expense_of({}, true), {}));
  EXPECT_DOUBLE_EQ(part_of(3, 0), 1);
}

}  // namespace storm_test
}  // namespace stormproof::exact
