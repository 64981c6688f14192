// live.no-stall from the rules: proved for both writers and all ways to open a relation, not where
// no certificate follows a timer, and mistakes in what recognition does break it.
#include "checker/engines/tables/no_stall.hpp"

#include <map>

#include "tests/checker/engines/tables/effect_mistake.hpp"
#include "tests/checker/engines/tables/table_check.hpp"

namespace stormproof::tables {
namespace no_stall_test {

Finding recognised(const model::Scenario& scenario, const checker::Mutant* mutant = nullptr,
                   bool second = false) {
  smt::Claims claims{{.second_solver = second}};
  const checker::CheckRequest request{
      .scenario = scenario, .claims = claims, .mutant = mutant, .on_progress = {}};
  return recognition_certificate(request);
}

model::Scenario each_side() {
  model::Scenario scenario = paper();
  scenario.dds.sedp.relation_opening = model::RelationOpening::each_side;
  scenario.dds.sedp.initial_data = model::InitialData::pull;
  scenario.dds.sedp.unmatched = model::Unmatched::drop;
  return scenario;
}

TEST(NoStall, IsProvedFromTheRules) {
  for (const model::Scenario& scenario : {paper(), each_side(), fastdds()}) {
    const Finding finding = decide("live.no-stall", scenario);
    EXPECT_EQ(finding.kind, VerdictKind::proved) << finding.how;
    EXPECT_TRUE(mentions(finding, "the next one is pending"));
    EXPECT_TRUE(mentions(finding, "what is missing is received by the limit + F"));
    EXPECT_EQ(recognised(scenario, nullptr, true).kind, VerdictKind::proved);
  }
}

TEST(NoStall, IsLeftOpenWhereNoCertificateFollowsATimer) {
  model::Scenario adaptive = paper();
  adaptive.dds.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  EXPECT_EQ(decide("live.no-stall", adaptive).kind, VerdictKind::inconclusive);
  model::Scenario additive = paper();
  additive.dds.sedp.heartbeat_timer = model::HeartbeatTimerKind::additive;
  EXPECT_EQ(decide("live.no-stall", additive).kind, VerdictKind::inconclusive);
}

TEST(NoStall, MistakesInRecognitionBreakItsCertificate) {
  using Change = fsm::composition::EffectMutation::Change;
  for (const auto& [scenario, rule, what, words] :
       {std::tuple{paper(), "AnnouncementIsDue", "at Announcement", "not so"},
        std::tuple{paper(), "AnnouncementIsDue", "emit SpdpMulticast", "not so"},
        std::tuple{paper(), "Hear", "set Recognised", "not so"},
        std::tuple{each_side(), "Hear", "raise WriterOpens", "lost at"},
        std::tuple{fastdds(), "Hear", "raise WriterOpens", "lost at"},
        std::tuple{fastdds(), "Hear", "raise ReaderOpens", "lost at"},
        std::tuple{fastdds(), "ReaderIsMatched", "set WriterOpen", "there is no step"},
        std::tuple{fastdds(), "ReaderIsMatched", "feed each C", "lost at"}}) {
    const checker::Mutant mutant = at_effect(scenario, rule, what, Change::drop);
    const Finding finding = recognised(scenario, &mutant);
    EXPECT_EQ(finding.kind, VerdictKind::inconclusive) << rule << ": " << what;
    EXPECT_TRUE(mentions(finding, words)) << rule << ": " << what;
  }
}

/// Several properties take something from one certificate: it is decided once.
TEST(NoStall, ACertificateIsDecidedOnceInACheck) {
  const model::Scenario scenario = paper();
  smt::Claims claims{{.second_solver = false}};
  std::map<std::string, Finding> known;
  checker::CheckRequest request{.scenario = scenario, .claims = claims, .on_progress = {}};
  request.known = &known;
  known["live.no-stall.recognition"].how = "decided before";
  EXPECT_EQ(recognition_certificate(request).how, "decided before");
}

}  // namespace no_stall_test
}  // namespace stormproof::tables
