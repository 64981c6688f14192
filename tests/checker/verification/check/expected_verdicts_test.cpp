// `check` answers what specs/expected/verdicts.yaml says, on reference scenarios of all
// implementations, and every counterexample has been confirmed by the simulator.
#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <string>
#include <vector>

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

const std::array<std::string, 5> names{"wired-5x20", "wifi-5x20", "wifi-5x20-fastdds",
                                       "live-5x20 --set dds=fastdds-server-2.6.11",
                                       "live-5x20 --set dds=cyclonedds-0.10"};

class ExpectedVerdicts : public testing::TestWithParam<std::string> {};

TEST_P(ExpectedVerdicts, AreWhatCheckAnswers) {
  // "NAME --set KEY=VALUE", as `check` takes it.
  const std::size_t option = GetParam().find(" --set ");
  std::vector<std::string> overrides;
  if (option != std::string::npos) overrides.push_back(GetParam().substr(option + 7));
  const auto scenario = model::config::read_scenario(GetParam().substr(0, option), overrides,
                                                     model::config::SpecPath::standard());
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
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Scenarios, ExpectedVerdicts, testing::ValuesIn(names.begin(), names.end()),
                         test_name);

TEST(ExpectedVerdicts, CoverEveryScenarioOfTheFile) {
  std::set<std::string> found;
  for (const auto& scenario : expected_file()) found.insert(scenario.first.as<std::string>());
  EXPECT_EQ(found, (std::set<std::string>{names.begin(), names.end()}));
}

}  // namespace expected_verdicts_test
}  // namespace stormproof::checker
