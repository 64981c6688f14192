// Boundary runs: an encoding that says something else than the machines do is a dispute, and it is
// said in what the runs differ from the scenario.
#include <algorithm>

#include <gtest/gtest.h>

#include "checker/engines/timeline/directed_check.hpp"
#include "checker/engines/timeline/needless_repair.hpp"
#include "tests/checker/engines/timeline/requests.hpp"

namespace stormproof::timeline {
namespace boundary_test {

using props::VerdictKind;

props::Finding held(std::vector<BoundaryPoint> points, const model::Scenario& scenario,
                    VerdictKind kind) {
  smt::Claims claims{{.second_solver = false}};
  const checker::CheckRequest request{.scenario = scenario, .claims = claims, .on_progress = {}};
  props::Finding finding;
  finding.kind = kind;
  hold_against_runs(points, "storm.free-threshold", request, finding);
  return finding;
}

TEST(BoundaryRuns, ThatAgreeLeaveTheVerdict) {
  const model::Scenario scenario = quiet_scenario();
  const std::vector<BoundaryPoint> points = threshold_points(scenario.dds);
  ASSERT_FALSE(points.empty());
  EXPECT_EQ(held(points, scenario, VerdictKind::proved).kind, VerdictKind::proved);
}

TEST(BoundaryRuns, AWrongEncodingIsDisputed) {
  const model::Scenario scenario = quiet_scenario();
  std::vector<BoundaryPoint> points = threshold_points(scenario.dds);
  points.back().expected = [](const Prediction&) { return "another number"; };
  for (const VerdictKind kind : {VerdictKind::proved, VerdictKind::violated}) {
    const props::Finding finding = held(points, scenario, kind);
    EXPECT_EQ(finding.kind, VerdictKind::disputed);
    EXPECT_NE(finding.how.find("another number"), std::string::npos) << finding.how;
  }
}

TEST(BoundaryRuns, SayWithWhatElseThanTheProfileTheyRun) {
  model::Scenario scenario = quiet_scenario();
  const auto told = [](const props::Finding& finding) { return finding.details.back(); };
  const std::string plain = told(held({}, scenario, VerdictKind::proved));
  EXPECT_EQ(plain.find("unlike"), std::string::npos) << plain;
  scenario.dds.sedp.piggyback = model::Piggyback::linear;
  scenario.dds.sedp.initial_data = model::InitialData::pull;
  const std::string altered =
      told(held(threshold_points(scenario.dds), scenario, VerdictKind::proved));
  EXPECT_NE(altered.find("unlike the scenario's profile"), std::string::npos) << altered;
  EXPECT_NE(altered.find("piggyback: off"), std::string::npos) << altered;
  EXPECT_NE(altered.find("initial_data: push"), std::string::npos) << altered;
}

}  // namespace boundary_test
}  // namespace stormproof::timeline
