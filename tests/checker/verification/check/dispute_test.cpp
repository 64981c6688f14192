// Solvers that contradict each other leave nothing established, whatever other engines found; a
// solver that merely has no answer takes away only the proof.
#include <gtest/gtest.h>

#include "checker/engines/smt/claims.hpp"
#include "checker/verification/check/check.hpp"
#include "model/config/scenario_file.hpp"
#include "tests/checker/engines/smt/solver_on_path.hpp"

namespace stormproof::checker {
namespace dispute_test {

using props::VerdictKind;

/// Answers every query so.
std::string always(const std::string& answer) {
  return "for file; do :; done; grep '(check-sat)' \"$file\" | sed 's/.*/" + answer + "/'";
}

/// The verdict on safety.ack-implies-received if cvc5 is this script.
VerdictKind verdict_with(const std::string& script) {
  const smt::FakeSolver fake{script};
  const auto scenario =
      model::config::read_scenario("smallest", {}, model::config::SpecPath::standard());
  smt::Claims claims;
  const CheckReport report =
      check({"safety.ack-implies-received"}, {*scenario, claims, nullptr, 0, 1, {}});
  return report.results.front().verdict;
}

TEST(Dispute, AContradictionIsInconclusive) {
  EXPECT_EQ(verdict_with(always("sat")), VerdictKind::inconclusive);
}

TEST(Dispute, NoAnswerLeavesWhatTheOtherEnginesFound) {
  EXPECT_EQ(verdict_with("echo unknown"), VerdictKind::bounded);
}

TEST(Dispute, AgreementProves) { EXPECT_EQ(verdict_with(always("unsat")), VerdictKind::proved); }

}  // namespace dispute_test
}  // namespace stormproof::checker
