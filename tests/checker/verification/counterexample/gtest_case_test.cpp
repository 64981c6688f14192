// The text of emitted tests; whether it compiles and does what it says, the build shows
// (emit_case.cpp).
#include "checker/verification/counterexample/gtest_case.hpp"

#include <gtest/gtest.h>

#include "tests/checker/verification/counterexample/examples.hpp"

namespace stormproof::counterexample {
namespace gtest_case_test {

TEST(GTestCase, NamesPropertyEventReasonAndFinder) {
  const std::string text = gtest_case(smallest(), "the explorer");
  EXPECT_NE(text.find("// storm.free-threshold: "), std::string::npos) << text;
  EXPECT_NE(text.find("// Violated at event 101, 13653072 ns after the start: At 13.653072 ms"),
            std::string::npos);
  EXPECT_NE(text.find("// Found by the explorer.\n"), std::string::npos);
  EXPECT_NE(text.find("TEST(Counterexample, StormFreeThresholdAtEvent101) {\n"), std::string::npos);
  EXPECT_NE(gtest_case(smallest()).find("// Found by stormproof check.\n"), std::string::npos);
}

TEST(GTestCase, ARawStringEndsWhereItShould) {
  props::Counterexample example = smallest();
  example.scenario.wireless.stages[0].name = ": )yaml";
  EXPECT_NE(gtest_case(example).find("R\"yaml_("), std::string::npos);
}

TEST(GTestCase, CommentsStayComments) {
  props::Counterexample example = smallest();
  example.reason = "first line\nint second_line \\";
  const std::string text = gtest_case(example);
  EXPECT_EQ(text.find("\nint second_line"), std::string::npos) << text;
  EXPECT_EQ(text.find("\\\n"), std::string::npos) << text;
}

TEST(GTestCase, AFileHasAllCasesAndTheIncludes) {
  const std::vector<props::Counterexample> both{smallest(), additive()};
  const std::string text = gtest_file(both);
  EXPECT_NE(text.find("#include <gtest/gtest.h>\n"), std::string::npos);
  EXPECT_NE(text.find("StormFreeThresholdAtEvent101"), std::string::npos);
  EXPECT_NE(text.find("TimerSingleHeartbeatAtEvent"), std::string::npos);
}

}  // namespace gtest_case_test
}  // namespace stormproof::counterexample
