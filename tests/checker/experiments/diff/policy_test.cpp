// Policies: the shipped ones are what the program defaults to, and a wrong one is refused with its
// place.
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "checker/experiments/diff/diff.hpp"
#include "checker/experiments/diff/verdicts.hpp"

namespace stormproof::diff {
namespace policy_test {

const model::config::SpecPath specs{{STORMPROOF_SPECS_DIR}};

std::string written(const std::string& text) {
  const auto file = std::filesystem::path{testing::TempDir()} / "policy-under-test.yaml";
  std::ofstream{file} << text;
  return file.string();
}

/// The error for a policy with this text, without the folder.
std::string error_of(const std::string& text) {
  const std::string file = written(text);
  const auto policy = read_policy(file, specs);
  if (policy) return "accepted";
  const std::string whole = to_string(policy.error());
  const auto at = whole.find("policy-under-test.yaml");
  return at == std::string::npos ? whole
                                 : whole.substr(at + std::string{"policy-under-test."}.size());
}

TEST(Policy, DefaultFileSaysWhatAnEmptyOneMeans) {
  const auto shipped = read_policy("default", specs);
  ASSERT_TRUE(shipped) << to_string(shipped.error());
  const auto empty = read_policy(written("{}"), specs);
  ASSERT_TRUE(empty) << to_string(empty.error());
  ASSERT_EQ(shipped->tolerances.size(), 2U);
  ASSERT_EQ(empty->tolerances.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(shipped->tolerances[k].measure, empty->tolerances[k].measure);
    EXPECT_EQ(shipped->tolerances[k].increase, empty->tolerances[k].increase);
  }
  EXPECT_EQ(shipped->unnoticed, empty->unnoticed);
  EXPECT_EQ(shipped->limits, empty->limits);
  EXPECT_EQ(shipped->limit_share, empty->limit_share);
  EXPECT_EQ(shipped->verdicts, empty->verdicts);
  EXPECT_EQ(shipped->strict_verdicts, empty->strict_verdicts);
  EXPECT_EQ(shipped->margin, empty->margin);
  EXPECT_EQ(shipped->confidence, empty->confidence);
  EXPECT_EQ(shipped->samples, empty->samples);
  EXPECT_EQ(shipped->most_samples, empty->most_samples);
}

TEST(Policy, StrictIsStricter) {
  const auto strict = read_policy("strict", specs);
  ASSERT_TRUE(strict) << to_string(strict.error());
  EXPECT_TRUE(strict->strict_verdicts);
  EXPECT_EQ(strict->limit_share, 0);
  EXPECT_EQ(strict->unnoticed.count(), 0);
  EXPECT_EQ(strict->tolerances.front().increase, 0.1);
  EXPECT_GT(strict->samples, Policy{}.samples);
}

TEST(Policy, EveryKeyIsRead) {
  const auto policy = read_policy(
      written("tolerances: {repair_data: 1/4, backlog: 0}\nlimits: {completion: 5s, backlog: 9}\n"
              "unnoticed: 20ms\nlimit_share: 10%\nverdicts: false\nmargin: false\n"
              "confidence: 0.9\nsamples: 5\nmost_samples: 7\n"),
      specs);
  ASSERT_TRUE(policy) << to_string(policy.error());
  EXPECT_EQ(policy->tolerances.at(0).measure, Measure::repair_data);
  EXPECT_EQ(policy->tolerances.at(0).increase, 0.25);
  EXPECT_EQ(policy->tolerances.at(1).increase, 0);
  EXPECT_EQ(policy->limits->completion->count(), 5'000'000'000);
  EXPECT_EQ(policy->limits->backlog, 9U);
  EXPECT_NEAR(policy->limit_share, 0.1, 1e-12);
  EXPECT_FALSE(policy->verdicts);
  EXPECT_FALSE(policy->margin);
  EXPECT_EQ(policy->confidence, 0.9);
  EXPECT_EQ(policy->samples, 5U);
  EXPECT_EQ(policy->most_samples, 7U);
}

TEST(Policy, MistakesAreRefusedWithTheirPlace) {
  EXPECT_NE(
      error_of("margin: true\nstorm_repairs: 0.2\n").find("yaml:2:16: storm_repairs is given up"),
      std::string::npos)
      << error_of("margin: true\nstorm_repairs: 0.2\n");
  EXPECT_EQ(error_of("tolerance: {}\n"),
            "yaml:1:1: unknown key 'tolerance'; did you mean 'tolerances'?");
  EXPECT_NE(error_of("tolerances: {completions: 5 %}\n").find("did you mean 'completion'"),
            std::string::npos);
  EXPECT_EQ(error_of("tolerances: 5 %\n").substr(0, 30), "yaml:1:13: tolerances: '5 %'; ");
  EXPECT_EQ(error_of("tolerances:\n  completion: -5 %\n"),
            "yaml:2:15: tolerances.completion: '-5 %'; expected a share from 0 to 1000, such as "
            "25 % or 0.25");
  EXPECT_EQ(
      error_of("confidence: 2\n"),
      "yaml:1:13: confidence: '2'; expected a share from 0.5 to 0.9999, such as 95 % or 0.95");
  EXPECT_EQ(error_of("verdicts: maybe\n"),
            "yaml:1:11: verdicts: 'maybe'; expected true, false or strict");
  EXPECT_EQ(error_of("margin: 1\n"), "yaml:1:9: margin: '1'; expected true or false");
  EXPECT_EQ(error_of("samples: 0\n"),
            "yaml:1:10: samples: '0'; expected a number from 1 to 100000");
  EXPECT_EQ(error_of("samples: 9\nmost_samples: 3\n"),
            "yaml:2:15: most_samples: '3'; expected at least samples, 9");
  EXPECT_NE(error_of("limits: {completion: 5}\n").find("no unit"), std::string::npos);
  EXPECT_NE(error_of("limits: {completions: 5s}\n").find("did you mean"), std::string::npos);
  EXPECT_NE(error_of("- a\n").find("yaml:1:1"), std::string::npos);
  EXPECT_NE(error_of("limit_share: [1]\n").find("a list"), std::string::npos);
}

TEST(Policy, NamesThatAreNotThere) {
  const auto wrong = read_policy("strickt", specs);
  ASSERT_FALSE(wrong);
  EXPECT_NE(to_string(wrong.error()).find("did you mean 'strict'"), std::string::npos);
  EXPECT_FALSE(read_policy("no/such.yaml", specs));
}

TEST(Verdicts, AreJudgedByThePolicy) {
  using props::VerdictKind;
  Policy policy;
  EXPECT_EQ(judge_verdicts(VerdictKind::proved, VerdictKind::violated, policy),
            Judgment::regression);
  EXPECT_EQ(judge_verdicts(VerdictKind::sampled, VerdictKind::violated, policy),
            Judgment::regression);
  EXPECT_EQ(judge_verdicts(VerdictKind::violated, VerdictKind::bounded, policy), Judgment::better);
  EXPECT_EQ(judge_verdicts(VerdictKind::proved, VerdictKind::sampled, policy), Judgment::same);
  EXPECT_EQ(judge_verdicts(VerdictKind::proved, VerdictKind::disputed, policy), Judgment::unclear);
  EXPECT_EQ(judge_verdicts(VerdictKind::disputed, VerdictKind::violated, policy),
            Judgment::unclear);
  EXPECT_EQ(judge_verdicts(VerdictKind::violated, VerdictKind::violated, policy), Judgment::same);
  EXPECT_EQ(judge_verdicts(VerdictKind::proved, VerdictKind::inconclusive, policy),
            Judgment::worse);
  EXPECT_EQ(judge_verdicts(VerdictKind::inconclusive, VerdictKind::violated, policy),
            Judgment::worse);
  policy.strict_verdicts = true;
  EXPECT_EQ(judge_verdicts(VerdictKind::proved, VerdictKind::inconclusive, policy),
            Judgment::unclear);
  policy.verdicts = false;
  EXPECT_EQ(judge_verdicts(VerdictKind::proved, VerdictKind::violated, policy), Judgment::worse);
}

}  // namespace policy_test
}  // namespace stormproof::diff
