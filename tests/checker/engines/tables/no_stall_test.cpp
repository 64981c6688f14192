// live.no-stall from the rules: proved for both writers and all ways to open a relation, not where
// no certificate follows a timer, and mistakes in what recognition does break it.
#include "checker/engines/tables/no_stall.hpp"

#include <filesystem>
#include <map>

#include <z3++.h>

#include "tests/checker/engines/tables/effect_mistake.hpp"
#include "tests/checker/engines/tables/table_check.hpp"
#include "tests/files.hpp"

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

/// Whoever reads the file finds what is claimed, and nothing in it is claimed of nothing: without
/// its invariant the question about every state has another answer.
TEST(NoStall, TheExportSaysWhatIsClaimed) {
  const files::Folder own;
  const std::filesystem::path& folder = own.path();
  for (const model::Scenario& scenario : {paper(), each_side(), fastdds()}) {
    smt::Claims claims{{.export_dir = folder.string(), .second_solver = false}};
    const checker::CheckRequest request{.scenario = scenario, .claims = claims, .on_progress = {}};
    EXPECT_EQ(recognition_certificate(request).kind, VerdictKind::proved);
    std::string text = files::content(folder / "certificates" / "live.no-stall.recognition.smt2");
    for (const char* words :
         {"; assumed: Of the announcements to one participant, which go on, some arrives",
          "; claimed of every state: whoever is recognised finds the reader's side opened",
          "; claimed of the step MulticastArrives: who hears an announcement recognises its",
          "; claimed of the step ReaderOpened: a reader's side that is opened is open"}) {
      EXPECT_NE(text.find(words), std::string::npos) << words;
    }
    const auto answers = [](const std::string& questions) {
      z3::context context;
      return std::string{Z3_eval_smtlib2_string(context, questions.c_str())};
    };
    EXPECT_EQ(answers(text).find("sat"), 2U);
    EXPECT_EQ(answers(text).find("\nsat"), std::string::npos);
    const std::size_t last = text.rfind("(assert (invariant");
    ASSERT_NE(last, std::string::npos);
    text.replace(last, 8, "(assert (or true ");
    text.insert(text.find("(assert (not (conclusion"), ")");
    EXPECT_TRUE(answers(text).ends_with("\nsat\n")) << answers(text);
  }
}

/// A solver that is stopped while it looks for an invariant leaves candidates that it has not
/// looked at. Nobody takes them for one: there is no answer, and no contradiction.
TEST(NoStall, ASolverThatIsStoppedMakesNoDispute) {
  std::size_t unanswered = 0;
  for (const unsigned budget : {1'000U, 10'000U, 50'000U, 200'000U}) {
    for (const char* property :
         {"live.no-stall", "composition.pending", "safety.ack-implies-received"}) {
      smt::Options options{.second_solver = false};
      options.budget.z3 = budget;
      const Finding finding = decide(property, paper(), nullptr, options);
      EXPECT_NE(finding.kind, VerdictKind::disputed) << property << ", " << budget << finding.how;
      EXPECT_EQ(finding.how.find("disputed"), std::string::npos) << finding.how;
      if (finding.how.find("in the search for an invariant") != std::string::npos) ++unanswered;
    }
  }
  EXPECT_GT(unanswered, 0U) << "no solver was stopped";
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
