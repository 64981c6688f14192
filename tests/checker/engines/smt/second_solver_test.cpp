// The second opinion: it agrees, contradicts, crashes, hangs, is absent; the export; nothing is
// left behind.
#include "checker/engines/smt/second_solver.hpp"

#include "checker/engines/smt/decision.hpp"
#include "tests/checker/engines/smt/solver_on_path.hpp"

namespace stormproof::smt {
namespace second_solver_test {

namespace fs = std::filesystem;

/// Three queries: unsat, sat, unsat; the last with names that need quoting.
void ask_three(Claims& claims, const std::string& property = "some.property") {
  z3::context context;
  const auto ask = [&](const char* query, const z3::expr& condition) {
    z3::expr_vector assertions{context};
    assertions.push_back(condition);
    return claims.decide(property, query, assertions).answer;
  };
  const z3::expr x = context.int_const("x");
  const z3::expr shared = context.bool_const("x of two\nsorts; (push");
  ASSERT_EQ(ask("first", x > 3 && x < 4), Answer::unsat);
  ASSERT_EQ(ask("second", x > 3), Answer::sat);
  ASSERT_EQ(ask("third\n(exit)", shared && !shared), Answer::unsat);
}

bool has_cvc5() { return !second_solver_name().empty(); }

TEST(SecondOpinion, AgreesIfTheAnswersAreEqual) {
  if (!has_cvc5()) GTEST_SKIP() << "cvc5 is not installed";
  Claims claims;
  ask_three(claims);
  const SecondOpinion opinion = claims.second_opinion("some.property");
  EXPECT_TRUE(opinion.asked);
  EXPECT_TRUE(opinion.agrees) << opinion.difference;
  EXPECT_EQ(opinion.solver.rfind("cvc5 ", 0), 0U);
  EXPECT_TRUE(opinion.difference.empty());
}

TEST(SecondOpinion, IsNotAskedAboutAPropertyWithoutQueries) {
  Claims claims;
  EXPECT_FALSE(claims.second_opinion("another.property").asked);
}

TEST(SecondOpinion, IsNotAskedIfItIsNotWanted) {
  Claims claims{{.second_solver = false}};
  ask_three(claims);
  const SecondOpinion opinion = claims.second_opinion("some.property");
  EXPECT_FALSE(opinion.asked);
  EXPECT_TRUE(opinion.agrees);
}

TEST(SecondOpinion, IsNotAskedIfThereIsNoSuchProgram) {
  const Variable path{"PATH", "/nonexistent"};
  Claims claims;
  ask_three(claims);
  const SecondOpinion opinion = claims.second_opinion("some.property");
  EXPECT_FALSE(opinion.asked);
  EXPECT_TRUE(opinion.solver.empty());
}

SecondOpinion opinion_of(const std::string& script) {
  const FakeSolver fake{script};
  Claims claims{{.timeout = std::chrono::milliseconds{100}}};
  ask_three(claims);
  return claims.second_opinion("some.property");
}

TEST(SecondOpinion, ASolverThatSaysTheOppositeDisagrees) {
  const SecondOpinion opinion = opinion_of("echo sat; echo unsat; echo sat");
  EXPECT_TRUE(opinion.asked);
  EXPECT_FALSE(opinion.agrees);
  EXPECT_TRUE(opinion.contradicts);
  EXPECT_EQ(opinion.difference, "first: z3 says unsat, cvc5 0.0.7 says sat");
}

TEST(SecondOpinion, OneWrongAnswerIsEnough) {
  const SecondOpinion opinion = opinion_of("echo unsat; echo unsat; echo unsat");
  EXPECT_FALSE(opinion.agrees);
  EXPECT_EQ(opinion.difference, "second: z3 says sat, cvc5 0.0.7 says unsat");
}

TEST(SecondOpinion, TheRightAnswersAgree) {
  const SecondOpinion opinion = opinion_of("echo unsat; echo sat; echo unsat");
  EXPECT_TRUE(opinion.agrees);
  EXPECT_FALSE(opinion.contradicts);
}

TEST(SecondOpinion, NoAnswerIsNoAgreement) {
  const SecondOpinion unknown = opinion_of("echo unsat; echo unknown; echo unsat");
  EXPECT_FALSE(unknown.agrees);
  EXPECT_FALSE(unknown.contradicts);
  EXPECT_NE(unknown.difference.find("second"), std::string::npos);
  const SecondOpinion silent = opinion_of("echo unsat; echo sat");
  EXPECT_FALSE(silent.agrees);
  EXPECT_NE(silent.difference.find("third (exit)"), std::string::npos);
  const SecondOpinion garbage = opinion_of("echo '(error \"oh dear\")'; exit 1");
  EXPECT_FALSE(garbage.agrees);
  EXPECT_NE(garbage.difference.find("first"), std::string::npos);
}

TEST(SecondOpinion, TooManyAnswersAreNoAgreement) {
  EXPECT_FALSE(opinion_of("echo unsat; echo sat; echo unsat; echo unsat").agrees);
}

TEST(SecondOpinion, ACrashIsNoAgreement) {
  const SecondOpinion opinion = opinion_of("echo unsat; kill -9 $$");
  EXPECT_TRUE(opinion.asked);
  EXPECT_FALSE(opinion.agrees);
  EXPECT_EQ(opinion.difference, "second: cvc5 0.0.7 gives no answer (ended by signal 9)");
}

TEST(SecondOpinion, ASolverThatHangsIsStopped) {
  const SecondOpinion opinion = opinion_of("exec sleep 100");
  EXPECT_FALSE(opinion.agrees);
  EXPECT_LT(opinion.seconds, 20.0);
  EXPECT_NE(opinion.difference.find("time-out"), std::string::npos);
}

TEST(SecondOpinion, LeavesNoFilesBehind) {
  const Folder folder;
  const Variable temporary{"TMPDIR", folder.path().string()};
  {
    Claims claims;
    ask_three(claims);
    (void)claims.second_opinion("some.property");
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Export, TheFileSaysWhatIsAskedAndExpected) {
  const Folder folder;
  Claims claims{
      {.export_dir = (folder.path() / "new" / "folder").string(), .second_solver = false}};
  ask_three(claims);
  const SecondOpinion opinion = claims.second_opinion("some.property");
  EXPECT_TRUE(opinion.problem.empty()) << opinion.problem;
  const std::string text = files::content(folder.path() / "new" / "folder" / "some.property.smt2");
  EXPECT_NE(text.find("; property: some.property\n"), std::string::npos);
  EXPECT_NE(text.find("; query: first\n; expected: unsat\n"), std::string::npos);
  EXPECT_NE(text.find("; query: second\n; expected: sat\n"), std::string::npos);
  EXPECT_NE(text.find("; query: third (exit)\n"), std::string::npos);
}

TEST(Export, TheFileIsDecidedByTheSecondSolverOnItsOwn) {
  if (!has_cvc5()) GTEST_SKIP() << "cvc5 is not installed";
  const Folder folder;
  Claims claims{{.export_dir = folder.path().string(), .second_solver = false}};
  ask_three(claims);
  (void)claims.second_opinion("some.property");
  const SolverRun run = ask_second_solver((folder.path() / "some.property.smt2").string(), 3, {});
  EXPECT_EQ(run.answers, (std::vector{Answer::unsat, Answer::sat, Answer::unsat}));
  EXPECT_TRUE(run.failure.empty()) << run.failure;
}

TEST(Export, APropertyNameCannotLeaveTheFolder) {
  const Folder folder;
  Claims claims{{.export_dir = (folder.path() / "in").string(), .second_solver = false}};
  ask_three(claims, "../out");
  EXPECT_TRUE(claims.second_opinion("../out").problem.empty());
  EXPECT_FALSE(fs::exists(folder.path() / "out.smt2"));
  EXPECT_TRUE(fs::exists(folder.path() / "in" / ".._out.smt2"));
}

TEST(Export, AFileThatCannotBeWrittenIsReported) {
  Claims claims{{.export_dir = "/proc/no-such-folder", .second_solver = false}};
  ask_three(claims);
  EXPECT_NE(claims.second_opinion("some.property").problem.find("cannot write"), std::string::npos);
}

}  // namespace second_solver_test
}  // namespace stormproof::smt
