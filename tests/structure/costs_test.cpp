// The implementations that there are cost no more than the list says, and the price of another one
// is seen by tests/model/push_once; the count can fail, which invented trees show.
#include "tests/structure/costs.hpp"

#include <gtest/gtest.h>

namespace stormproof::structure {
namespace costs_test {

using Complaints = std::vector<std::string>;

TEST(Costs, OfEachImplementationDoNotGrow) {
  const std::string root = STORMPROOF_SOURCE_DIR;
  Texts texts = read_texts(root, {"fsm", "model", "props", "checker"});
  texts.merge(read_texts(root, {"tests/model/push_once"}));
  const auto rows = read_words(root + "/tests/structure/vendors.txt");
  ASSERT_EQ(rows.size(), 5U);
  for (const std::vector<std::string>& words : rows) {
    ASSERT_EQ(words.size(), 3U) << "expected: word lines folders";
    EXPECT_EQ(check_cost(texts, {words[0], std::stoul(words[1]), std::stoul(words[2])}),
              Complaints{});
  }
}

std::string lines(std::size_t count) { return std::string(count, '\n'); }

const Texts tree{{"model/storm/host.hpp", lines(40)},  {"model/storm/host.cpp", lines(30)},
                 {"rules/stormy.hpp", lines(50)},      {"rules/thunderstorm.hpp", lines(500)},
                 {"rules/brainstorm.hpp", lines(500)}, {"rules/calm.hpp", lines(500)}};

TEST(Costs, AreThoseOfFilesWithTheWordInTheirPath) {
  const VendorCost cost = cost_of(tree, "storm");
  EXPECT_EQ(cost.lines, 120U);
  EXPECT_EQ(cost.folders, 2U);
}

TEST(Costs, ThatGrowAreNoticed) {
  EXPECT_EQ(check_cost(tree, {"storm", 120, 2}), Complaints{});
  EXPECT_EQ(check_cost(tree, {"storm", 119, 1}),
            (Complaints{"storm has 120 lines, at most 119 are allowed",
                        "storm has 2 folders, at most 1 are allowed"}));
}

TEST(Costs, ThatFallAreWrittenDown) {
  EXPECT_EQ(check_cost(tree, {"storm", 141, 3}),
            (Complaints{"storm has 120 lines: the list can say less than 141",
                        "storm has 2 folders: the list can say less than 3"}));
}

}  // namespace costs_test
}  // namespace stormproof::structure
