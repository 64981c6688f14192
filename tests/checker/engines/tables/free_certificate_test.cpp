// storm.free-threshold from the rules: below the threshold nothing is ever repaired, at it plus one
// nanosecond that is not proved, and mistakes between the machines break it.
#include "checker/engines/tables/free_certificate.hpp"

#include "tests/checker/engines/tables/effect_mistake.hpp"
#include "tests/checker/engines/tables/table_check.hpp"

namespace stormproof::tables {
namespace free_certificate_test {

Finding certified(const model::Scenario& scenario, int more = 0,
                  const checker::Mutant* mutant = nullptr, bool second = false) {
  smt::Claims claims{{.second_solver = second}};
  const checker::CheckRequest request{
      .scenario = scenario, .claims = claims, .mutant = mutant, .on_progress = {}};
  return free_certificate(request, more);
}

TEST(FreeCertificate, NothingIsRepairedBelowTheThreshold) {
  const model::Scenario scenario = paper();
  ASSERT_TRUE(has_free_certificate(scenario.dds));
  const Finding finding = certified(scenario, 0, nullptr, true);
  EXPECT_EQ(finding.kind, VerdictKind::proved) << finding.how;
  EXPECT_TRUE(mentions(finding, "it is never requested"));
  EXPECT_EQ(certified(scenario, 1).kind, VerdictKind::inconclusive);
}

TEST(FreeCertificate, IsAboutPushedDataOfThePapersWriter) {
  model::Scenario pull = paper();
  pull.dds.sedp.initial_data = model::InitialData::pull;
  EXPECT_FALSE(has_free_certificate(pull.dds));
  EXPECT_FALSE(has_free_certificate(fastdds().dds));
}

TEST(FreeCertificate, MistakesBetweenTheMachinesBreakIt) {
  using Change = fsm::composition::EffectMutation::Change;
  const model::Scenario scenario = paper();
  for (const auto& [rule, what, change] :
       {std::tuple{"TakeHeartbeat", "after AckNackGeneration", Change::at_once},
        std::tuple{"ReaderOpened", "at InitialAttempt", Change::at_once},
        std::tuple{"WriterSideOpens", "perform Generate", Change::drop}}) {
    const checker::Mutant mutant = at_effect(scenario, rule, what, change);
    const Finding finding = certified(scenario, 0, &mutant);
    EXPECT_EQ(finding.kind, VerdictKind::inconclusive) << rule;
    EXPECT_TRUE(mentions(finding, "lost at")) << rule;
  }
}

}  // namespace free_certificate_test
}  // namespace stormproof::tables
