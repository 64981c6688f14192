// The theorems are proved, and nothing stronger is: a bound less one nanosecond and a border off by
// one are refuted.
#include <gtest/gtest.h>

#include "checker/engines/timeline/completion_theorem.hpp"
#include "checker/engines/timeline/quiescence.hpp"
#include "checker/engines/timeline/single_copy.hpp"
#include "tests/checker/engines/timeline/requests.hpp"

namespace stormproof::timeline {
namespace theorem_test {

class Theorems : public testing::Test {
 protected:
  template <class Prove>
  bool proves(Prove&& prove, smt::Options options = z3_only()) {
    const props::Finding finding = finding_of(prove, std::move(options));
    how_ = finding.how;
    return finding.kind == props::VerdictKind::proved;
  }
  std::string how_;
};

TEST_F(Theorems, CompletionIsProvedByBothSolvers) {
  EXPECT_TRUE(proves([](Theorem& t) { prove_completion(t); }, {})) << how_;
}

TEST_F(Theorems, NoPartOfTheCompletionBoundCanBeSmaller) {
  for (const Tightening& tighter :
       {Tightening{1, 0, 0}, Tightening{0, 1, 0}, Tightening{0, 0, 1}}) {
    EXPECT_FALSE(proves([&](Theorem& t) { prove_completion(t, tighter); }));
    EXPECT_NE(how_.find("refuted"), std::string::npos) << how_;
  }
}

TEST_F(Theorems, SingleCopyHasExactlyTheseBorders) {
  EXPECT_TRUE(proves([](Theorem& t) { prove_single_copy(t); }, {})) << how_;
  for (const BorderShift& shift :
       {BorderShift{1, 0}, BorderShift{-1, 0}, BorderShift{0, 1}, BorderShift{0, -1}}) {
    EXPECT_FALSE(proves([&](Theorem& t) { prove_single_copy(t, shift); }));
    EXPECT_NE(how_.find("refuted"), std::string::npos) << how_;
  }
}

TEST_F(Theorems, QuiescenceIsProvedAndNotSooner) {
  EXPECT_TRUE(proves([](Theorem& t) { prove_quiescence(t); }, {})) << how_;
  EXPECT_FALSE(proves([](Theorem& t) { prove_quiescence(t, 1); }));
  EXPECT_NE(how_.find("refuted"), std::string::npos) << how_;
}

TEST_F(Theorems, WhatIsRefutedImpossibleOrOpenIsNotProved) {
  EXPECT_FALSE(proves([](Theorem& t) { t.holds("x is positive", t.number("x") > 0); }));
  EXPECT_FALSE(proves([](Theorem& t) {
    const Int x = t.number("x");
    t.possible("x is less than itself", x < x);
  }));
  EXPECT_FALSE(proves([](Theorem& t) { t.give_up("interrupted"); }));
  EXPECT_TRUE(proves([](Theorem& t) { t.holds("x is not negative", t.at_least("x", 0) >= 0); }));
}

}  // namespace theorem_test
}  // namespace stormproof::timeline
