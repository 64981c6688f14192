// Which misspellings get a suggestion, and which do not.
#include "model/config/tree/suggestion.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace stormproof::model::config {
namespace suggestion_test {

const std::vector<std::string> keys{"heartbeat_period", "heartbeat_policy", "grouping"};

TEST(Suggestion, the_nearest_key_is_named) {
  EXPECT_EQ(suggestion("heartbeat_perod", keys), "; did you mean 'heartbeat_period'?");
  EXPECT_EQ(suggestion("heartbeat_polcy", keys), "; did you mean 'heartbeat_policy'?");
  EXPECT_EQ(suggestion("groupin", keys), "; did you mean 'grouping'?");
}

TEST(Suggestion, nothing_is_suggested_for_a_word_that_is_far_away) {
  EXPECT_EQ(suggestion("wireless", keys), "");
  EXPECT_EQ(suggestion("", keys), "");
  EXPECT_EQ(suggestion(std::string(1'000'000, 'x'), keys), "");
  EXPECT_EQ(suggestion("x", {}), "");
}

}  // namespace suggestion_test
}  // namespace stormproof::model::config
