// Z3's side of the claims: answers, models, time-outs, errors.
#include "checker/engines/smt/claims.hpp"

#include <atomic>

#include <gtest/gtest.h>

#include "checker/engines/smt/deadline.hpp"
#include "checker/engines/smt/decision.hpp"

namespace stormproof::smt {
namespace claims_test {

z3::expr_vector list(std::initializer_list<z3::expr> expressions) {
  z3::expr_vector vector{expressions.begin()->ctx()};
  for (const z3::expr& expression : expressions) vector.push_back(expression);
  return vector;
}

TEST(Claims, ASatisfiableQueryComesWithAModel) {
  z3::context context;
  Claims claims;
  const z3::expr x = context.int_const("x");
  const Decision decision = claims.decide("p", "x between", list({x > 3, x < 5}));
  ASSERT_EQ(decision.answer, Answer::sat);
  ASSERT_TRUE(decision.model);
  EXPECT_EQ(decision.model->eval(x).to_string(), "4");
  EXPECT_TRUE(decision.why.empty());
}

TEST(Claims, AContradictionIsUnsat) {
  z3::context context;
  Claims claims;
  const z3::expr x = context.int_const("x");
  const Decision decision = claims.decide("p", "x", list({x > 3, x < 4}));
  EXPECT_EQ(decision.answer, Answer::unsat);
  EXPECT_FALSE(decision.model);
}

TEST(Claims, NoAssertionsAreSatisfiable) {
  z3::context context;
  Claims claims;
  EXPECT_EQ(claims.decide("p", "nothing", z3::expr_vector{context}).answer, Answer::sat);
}

/// A sum of three cubes that nobody has found.
z3::expr_vector open_question(z3::context& context) {
  const auto cube = [&](const char* name) {
    const z3::expr x = context.int_const(name);
    return x * x * x;
  };
  return list({cube("x") + cube("y") + cube("z") == 114});
}

TEST(Claims, AForcedTimeOutIsUnknownAndNeverHolds) {
  z3::context context;
  for (const int limit_ms : {1, 200}) {
    Claims claims{{.timeout = std::chrono::milliseconds{limit_ms}}};
    const Decision decision = claims.decide("p", "cubes", open_question(context));
    EXPECT_EQ(decision.answer, Answer::unknown);
    EXPECT_FALSE(decision.model);
    EXPECT_FALSE(decision.why.empty());
    EXPECT_LT(decision.seconds, 5.0);
  }
}

TEST(Claims, AnInterruptionIsNoAnswer) {
  z3::context context;
  std::atomic<int> asked = 0;
  Claims claims{{.timeout = std::chrono::hours{1}, .interrupted = [&] { return ++asked > 3; }}};
  EXPECT_THROW((void)claims.decide("p", "cubes", open_question(context)), Interrupted);
  const int before = asked;
  EXPECT_THROW((void)claims.decide("p", "cubes", open_question(context)), Interrupted);
  EXPECT_EQ(asked, before + 1);  // it does not even begin
}

TEST(Claims, AnErrorOfTheSolverIsUnknownWithItsReason) {
  z3::context context;
  Claims claims;
  const Decision decision = claims.decide("p", "a number", list({context.int_val(7)}));
  EXPECT_EQ(decision.answer, Answer::unknown);
  EXPECT_FALSE(decision.why.empty());
}

TEST(Claims, TheSolverNamesItsVersion) {
  EXPECT_EQ(Claims{}.solver_name().rfind("z3 ", 0), 0U);
  EXPECT_EQ(Claims({.seed = 7}).options().seed, 7U);
}

}  // namespace claims_test
}  // namespace stormproof::smt
