// One definition of a storm, by what is known of a discovery.
#include "checker/engines/exact/storm.hpp"

#include <gtest/gtest.h>

namespace stormproof::exact {
namespace storm_test {

Expense of_a_model(double airtime, double stretch) {
  Expense took;
  took.airtime = airtime;
  took.stretch = stretch;
  return took;
}

Expense of_a_capture(double messages, bool is_late) {
  Expense took;
  took.messages = messages;
  took.is_late = is_late;
  return took;
}

TEST(Storm, TakesThreeTimesTheAirtimeAndTheTime) {
  EXPECT_TRUE(is_storm(of_a_model(3, 3)));
  EXPECT_FALSE(is_storm(of_a_model(2.99, 30))) << "a slow link, or waiting";
  EXPECT_FALSE(is_storm(of_a_model(30, 2.99))) << "repeats that do not decide";
}

TEST(Storm, MessagesStandForAirtimeAndDoNotSayThatItIsLate) {
  EXPECT_TRUE(is_storm(of_a_capture(3, true)));
  EXPECT_FALSE(is_storm(of_a_capture(2.95, true)));
  EXPECT_FALSE(is_storm(of_a_capture(30, false)));
}

TEST(Storm, FromTwiceTheMessagesOnItIsAmplified) {
  EXPECT_TRUE(is_amplified(of_a_capture(2.95, false)));
  EXPECT_FALSE(is_amplified(of_a_capture(2, true)));
  EXPECT_FALSE(is_amplified(of_a_model(30, 30))) << "nothing is known of messages";
}

TEST(Storm, WhatIsNotKnownIsNone) {
  Expense took;
  took.is_late = true;
  EXPECT_FALSE(is_storm(took));
  took.airtime = 30;
  EXPECT_FALSE(is_storm(took)) << "nothing is known of the time";
}

}  // namespace storm_test
}  // namespace stormproof::exact
