// Expressions fold what is constant, and are refused where they would not be what was read.
#include "checker/engines/promela/script.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

namespace stormproof::promela {
namespace script_test {

TEST(Script, FoldsWhatIsConstant) {
  Script script{2};
  const Truth flag = script.truth("Flag");
  const auto text = [](const Truth& truth) { return truth.expression().text; };
  EXPECT_EQ(text(flag && true), "Flag");
  EXPECT_TRUE((flag && false).is(false));
  EXPECT_TRUE((flag || true).is(true));
  EXPECT_EQ(text(!!(flag || false)), "Flag");
  EXPECT_EQ(text(flag && !script.bit("Bits", 1)), "(Flag && !(Bits >> 1 & 1))");
  EXPECT_TRUE((Number{2} * 3 + 1 > 6).is(true));
  EXPECT_EQ(text(script.number("Count") == 0), "(Count == 0)");
}

TEST(Script, SaysASetAsABitmap) {
  Script script{2};
  EXPECT_EQ((Lanes{{false, true}}).bitmap().expression().constant, 2);
  EXPECT_EQ((Lanes{{script.truth("Low"), script.truth("High")}}).bitmap().expression().text,
            "((High * 2) + Low)");
  EXPECT_TRUE((Lanes{{false, false}}).any().is(false));
}

TEST(Script, RefusesWhatHasChangedSinceItWasRead) {
  Script script{1};
  const Truth before = script.truth("Flag");
  script.assign("Other", before.expression());
  script.assign("Flag", Truth{true}.expression());
  EXPECT_THROW(script.assign("Other", before.expression()), std::logic_error);
  EXPECT_THROW(script.assign("Other", (before && script.truth("Flag")).expression()),
               std::logic_error);
  script.assign("Other", script.truth("Flag").expression());
}

TEST(Script, RefusesWhatDependsOnATime) {
  Script script{1};
  EXPECT_THROW(script.when(Number::unknown() > 0, [] {}), std::logic_error);
  script.when(Number::unknown() > 0 && false, [] {});  // nobody asks
  EXPECT_TRUE(script.take_lines().empty());
}

TEST(Script, LeavesOutConditionsOfNothing) {
  Script script{1};
  script.when(script.truth("Flag"), [] {});
  EXPECT_TRUE(script.take_lines().empty());
  script.when(script.truth("Flag"), [&] { script.send("Data"); });
  EXPECT_EQ(script.take_lines(),
            (std::vector<std::string>{"if", ":: Flag ->", "     send_Data();", ":: else", "fi;"}));
  EXPECT_EQ(script.take_sends().at("Data"), 1U);
}

}  // namespace script_test
}  // namespace stormproof::promela
