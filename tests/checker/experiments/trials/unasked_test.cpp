// What was not asked, in words.
#include "checker/experiments/trials/unasked.hpp"

#include <gtest/gtest.h>

namespace stormproof::trials {
namespace unasked_test {

TEST(Unasked, SaysWhatThereWasNoTimeFor) {
  Unasked unasked;
  unasked.note("runs of the search", 1'200, 1'200);
  EXPECT_FALSE(unasked.lacked_time());
  EXPECT_TRUE(sentences_of(unasked).empty());
  unasked.note("runs of the search", 340, 1'200);
  unasked.left_out.emplace_back("pairs");
  unasked.cuts.push_back({"runs of the search", 12, model::Nanoseconds{4'000'000'000}});
  EXPECT_TRUE(unasked.lacked_time());
  EXPECT_EQ(sentences_of(unasked),
            (std::vector<std::string>{"340 of 1,200 runs of the search", "no pairs",
                                      "cut: 12 runs of the search at 4.000 s of simulated time"}));
  report::Facts facts;
  add_unasked(facts, unasked);
  ASSERT_EQ(facts.rows.size(), 2U);
}

/// What is cut because it cannot change the answer takes no time that was asked for.
TEST(Unasked, ACutAloneIsNoLackOfTime) {
  Unasked unasked;
  unasked.cuts.push_back({"runs", 1, model::Nanoseconds{1}});
  EXPECT_FALSE(unasked.lacked_time());
  report::Facts facts;
  add_unasked(facts, unasked);
  EXPECT_EQ(facts.rows.size(), 1U);
}

}  // namespace unasked_test
}  // namespace stormproof::trials
