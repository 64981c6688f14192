// A finding says no more than its searches have decided.
#include "checker/engines/explorer/answer.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace stormproof::explorer {
namespace answer_test {

using props::Finding;
using props::VerdictKind;

SearchResult a_search(CutShort cut_short, std::uint32_t undecided = 0) {
  SearchResult result;
  result.states = 100;
  result.depth = 7;
  result.cut_short = cut_short;
  result.undecided = undecided;
  return result;
}

bool says(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

TEST(Answer, IsBoundedByWhatWasExhausted) {
  Answer answer;
  Scope scope;
  answer.note_scope(scope, Claim::snapshot, a_search(CutShort::no), {});
  EXPECT_EQ(answer.finding(Claim::snapshot, {}).kind, VerdictKind::bounded);
  EXPECT_FALSE(says(answer.finding(Claim::snapshot, {}).how, "not decided"));
  scope.losses = 2;
  answer.note_scope(scope, Claim::snapshot, a_search(CutShort::by_limit), {});
  const Finding finding = answer.finding(Claim::snapshot, {});
  EXPECT_EQ(finding.kind, VerdictKind::bounded);
  EXPECT_TRUE(says(finding.how, "not decided: D = 1, k = 2 (all paths of up to 7 events)"))
      << finding.how;
  EXPECT_TRUE(says(finding.details.back(), "the limit of states is reached"));
}

TEST(Answer, IsNoneIfNothingWasExhausted) {
  for (const CutShort cut :
       {CutShort::by_limit, CutShort::by_overflow, CutShort::by_interruption}) {
    Answer answer;
    answer.note_scope({}, Claim::snapshot, a_search(cut), {});
    const Finding finding = answer.finding(Claim::snapshot, {});
    EXPECT_EQ(finding.kind, VerdictKind::inconclusive);
    EXPECT_TRUE(says(finding.how, "D = 1, k = 0 (all paths of up to 7 events)")) << finding.how;
  }
}

TEST(Answer, IsNoneIfItIsInterrupted) {
  Answer answer;
  answer.note_scope({}, Claim::snapshot, a_search(CutShort::no), {});
  Surroundings surroundings;
  surroundings.interrupted = true;
  EXPECT_EQ(answer.finding(Claim::snapshot, surroundings).kind, VerdictKind::inconclusive);
}

TEST(Answer, LeavesStallsOpenThatNobodyKnowsOf) {
  Answer stalls;
  stalls.note_scope({}, Claim::no_stall, a_search(CutShort::no, 3), {});
  EXPECT_EQ(stalls.finding(Claim::no_stall, {}).kind, VerdictKind::inconclusive);
  Answer other;  // is none of their business
  other.note_scope({}, Claim::snapshot, a_search(CutShort::no, 3), {});
  EXPECT_EQ(other.finding(Claim::snapshot, {}).kind, VerdictKind::bounded);
}

TEST(Answer, IsDisputedIfTheSimulatorDoesNotConfirmAPath) {
  Answer answer;
  answer.note_scope({}, Claim::snapshot, a_search(CutShort::no), {});
  answer.note_dispute({}, 9, "The monitor does not object.");
  const Finding finding = answer.finding(Claim::snapshot, {});
  EXPECT_EQ(finding.kind, VerdictKind::disputed);
  EXPECT_TRUE(says(finding.how, "A path of 9 events")) << finding.how;
}

TEST(Answer, StatesWhatTheWorldLeavesOut) {
  const auto has = [](const model::Scenario& scenario, std::string_view part) {
    return std::ranges::any_of(assumptions_of(scenario, {}), [&](const std::string& assumption) {
      return says(assumption, part);
    });
  };
  model::Scenario scenario;
  scenario.wireless.kind = model::ServiceKind::shared_channel;
  EXPECT_TRUE(has(scenario, "A repair leaves its source after what is received at the same"));
  EXPECT_FALSE(has(scenario, "No HEARTBEATs ride"));
  scenario.dds.implementation = model::ImplementationKind::fastdds;
  EXPECT_FALSE(has(scenario, "A repair leaves its source"));
  EXPECT_TRUE(has(scenario, "No HEARTBEATs ride"));
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.dds.implementation = model::ImplementationKind::paper;
  EXPECT_FALSE(has(scenario, "A repair leaves its source"));
}

}  // namespace answer_test
}  // namespace stormproof::explorer
