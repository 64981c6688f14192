// `check` answers what specs/expected/verdicts.yaml says, on reference scenarios of both
// implementations, and every counterexample has been confirmed by the simulator.
#include <map>

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "checker/engines/smt/claims.hpp"
#include "checker/verification/check/check.hpp"
#include "model/config/scenario_file.hpp"

namespace stormproof::checker {
namespace expected_verdicts_test {

using Verdicts = std::map<std::string, std::string>;  // property → verdict

YAML::Node expected_file() {
  static const YAML::Node file = YAML::LoadFile(STORMPROOF_SPECS_DIR "/expected/verdicts.yaml");
  return file;
}

Verdicts expected(const std::string& scenario) {
  Verdicts verdicts;
  for (const auto& group : expected_file()[scenario]) {
    const auto verdict = group.first.as<std::string>();
    for (const auto& entry : group.second) {
      const bool with_reason = verdict == "violated";
      const auto id = with_reason ? entry.first.as<std::string>() : entry.as<std::string>();
      EXPECT_TRUE(verdicts.emplace(id, verdict).second) << scenario << ": twice: " << id;
      if (with_reason) {
        EXPECT_GE(entry.second.as<std::string>().size(), 10U) << id;
      }
    }
  }
  return verdicts;
}

class ExpectedVerdicts : public testing::TestWithParam<std::string> {};

TEST_P(ExpectedVerdicts, AreWhatCheckAnswers) {
  const auto scenario =
      model::config::read_scenario(GetParam(), {}, model::config::SpecPath::standard());
  ASSERT_TRUE(scenario);
  smt::Claims claims;
  CheckRequest request{*scenario, claims, nullptr, 0, 2, {}};
  const CheckReport report = check({}, request);
  Verdicts actual;
  for (const PropertyResult& result : report.results) {
    actual.emplace(result.property->id, name_of(result.verdict));
    const bool violated = result.verdict == props::VerdictKind::violated;
    EXPECT_EQ(result.counterexample() != nullptr, violated) << result.property->id;
    for (const props::Finding& finding : result.findings) {
      EXPECT_FALSE(finding.how.empty()) << result.property->id;
      EXPECT_NE(finding.kind, props::VerdictKind::disputed) << result.property->id << finding.how;
    }
  }
  EXPECT_EQ(actual, expected(GetParam()));
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Scenarios, ExpectedVerdicts,
                         testing::Values("wired-5x20", "wifi-5x20", "wifi-5x20-fastdds"),
                         test_name);

TEST(ExpectedVerdicts, CoverEveryScenarioOfTheFile) {
  std::set<std::string> names;
  for (const auto& scenario : expected_file()) names.insert(scenario.first.as<std::string>());
  EXPECT_EQ(names, (std::set<std::string>{"wired-5x20", "wifi-5x20", "wifi-5x20-fastdds"}));
}

}  // namespace expected_verdicts_test
}  // namespace stormproof::checker
