// storm.free-threshold and storm.single-copy from the rules: below the threshold nothing is ever
// repaired or sent twice, at it plus one nanosecond that is not proved, and mistakes between the
// machines break it.
#include "checker/engines/tables/free_certificate.hpp"

#include "tests/checker/engines/tables/effect_mistake.hpp"
#include "tests/checker/engines/tables/table_check.hpp"

namespace stormproof::tables {
namespace free_certificate_test {

struct How {
  bool constant = false;
  int more = 0;
  const checker::Mutant* mutant = nullptr;
  bool second = false;
};

Finding certified(const model::Scenario& scenario, const How& how) {
  smt::Claims claims{{.second_solver = how.second}};
  const checker::CheckRequest request{
      .scenario = scenario, .claims = claims, .mutant = how.mutant, .on_progress = {}};
  return free_certificate(request, how.constant, how.more);
}

model::Scenario with_initial(model::InitialAckNackReply reply, model::Nanoseconds delay) {
  model::Scenario scenario = paper();
  scenario.dds.sedp.initial_acknack = reply;
  scenario.dds.sedp.initial_acknack_delay = delay;
  return scenario;
}

TEST(FreeCertificate, NothingIsRepairedBelowTheThreshold) {
  for (const bool constant : {false, true}) {
    const model::Scenario scenario = paper();
    ASSERT_TRUE(certified_free(scenario.dds, constant));
    const Finding finding = certified(scenario, {.constant = constant, .second = true});
    EXPECT_EQ(finding.kind, VerdictKind::proved) << finding.how;
    EXPECT_TRUE(mentions(finding, "it is never requested"));
    EXPECT_TRUE(mentions(finding, "it is sent once"));
    EXPECT_EQ(certified(scenario, {.constant = constant, .more = 1}).kind,
              VerdictKind::inconclusive);
  }
}

TEST(FreeCertificate, InitialAckNacksThatAskForNothingDoNotMatter) {
  const model::Nanoseconds delay = paper().dds.sedp.initial_acknack_delay;
  model::Scenario late = with_initial(model::InitialAckNackReply::none, delay);
  late.dds.sedp.relation_opening = model::RelationOpening::each_side;
  late.dds.sedp.unmatched = model::Unmatched::accept;
  for (const model::Scenario& scenario :
       {with_initial(model::InitialAckNackReply::heartbeat, delay),
        with_initial(model::InitialAckNackReply::bitmap, model::Nanoseconds{0}), late}) {
    EXPECT_EQ(certified_free(scenario.dds, false), scenario.dds.sedp.heartbeat_response_delay);
    const Finding finding = certified(scenario, {});
    EXPECT_EQ(finding.kind, VerdictKind::proved) << finding.how;
    EXPECT_EQ(certified(scenario, {.more = 1}).kind, VerdictKind::inconclusive);
    // At constant delays nothing is left that could ask too early.
    EXPECT_EQ(certified(scenario, {.constant = true}).kind, VerdictKind::proved);
  }
}

TEST(FreeCertificate, IsAboutPushedDataOfThePapersWriter) {
  model::Scenario pull = paper();
  pull.dds.sedp.initial_data = model::InitialData::pull;
  model::Scenario late = paper();
  late.dds.sedp.relation_opening = model::RelationOpening::each_side;
  for (const model::Scenario& scenario : {pull, late, fastdds()}) {
    EXPECT_FALSE(certified_free(scenario.dds, false));
    EXPECT_FALSE(certified_free(scenario.dds, true));
  }
}

TEST(FreeCertificate, MistakesBetweenTheMachinesBreakIt) {
  using Change = fsm::composition::EffectMutation::Change;
  const model::Scenario scenario = paper();
  for (const auto& [rule, what, change] :
       {std::tuple{"TakeHeartbeat", "after AckNackGeneration", Change::at_once},
        std::tuple{"ReaderOpened", "at InitialAttempt", Change::at_once},
        std::tuple{"WriterSideOpens", "perform Generate", Change::twice},
        std::tuple{"WriterSideOpens", "perform Generate", Change::drop}}) {
    const checker::Mutant mutant = at_effect(scenario, rule, what, change);
    const Finding finding = certified(scenario, {.mutant = &mutant});
    EXPECT_EQ(finding.kind, VerdictKind::inconclusive) << rule;
    EXPECT_TRUE(mentions(finding, "lost at")) << rule;
  }
}

}  // namespace free_certificate_test
}  // namespace stormproof::tables
