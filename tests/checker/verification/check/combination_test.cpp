// Which of several findings decides a property, and what the reports say about it.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <tinyxml2.h>

#include "checker/presentation/document/render.hpp"
#include "checker/verification/check/check.hpp"
#include "checker/verification/check/check_report.hpp"

namespace stormproof::checker {
namespace combination_test {

using props::Finding;
using props::VerdictKind;

Finding finding(VerdictKind kind, std::string engine = "tables", bool disputed = false) {
  Finding result;
  result.kind = kind;
  result.engine = std::move(engine);
  result.how = "how";
  result.assumptions = {"an assumption"};
  result.disputed = disputed;
  return result;
}

VerdictKind combined(const std::vector<Finding>& findings) {
  return findings[deciding_finding(findings)].kind;
}

TEST(Combination, TheStrongestVerdictThatHoldsDecides) {
  EXPECT_EQ(combined({finding(VerdictKind::sampled), finding(VerdictKind::bounded)}),
            VerdictKind::bounded);
  EXPECT_EQ(combined({finding(VerdictKind::bounded), finding(VerdictKind::proved)}),
            VerdictKind::proved);
  EXPECT_EQ(combined({finding(VerdictKind::inconclusive), finding(VerdictKind::sampled)}),
            VerdictKind::sampled);
}

TEST(Combination, OneViolationOverrulesEveryProof) {
  EXPECT_EQ(combined({finding(VerdictKind::proved), finding(VerdictKind::violated)}),
            VerdictKind::violated);
  EXPECT_EQ(combined({finding(VerdictKind::violated),
                      finding(VerdictKind::inconclusive, "tables", true)}),
            VerdictKind::violated);
}

TEST(Combination, SolversThatDisagreeLeaveNothingEstablished) {
  EXPECT_EQ(
      combined({finding(VerdictKind::bounded), finding(VerdictKind::inconclusive, "tables", true)}),
      VerdictKind::inconclusive);
}

TEST(Combination, ATimeOutOfOneEngineDoesNotTakeAwayWhatAnotherEstablished) {
  EXPECT_EQ(combined({finding(VerdictKind::inconclusive), finding(VerdictKind::bounded)}),
            VerdictKind::bounded);
}

TEST(Combination, OfEqualFindingsTheFirstDecides) {
  EXPECT_EQ(deciding_finding({finding(VerdictKind::proved), finding(VerdictKind::proved)}), 0U);
}

class Reports : public testing::Test {
 protected:
  Reports() {
    const auto add = [&](std::string_view id, std::vector<Finding> findings) {
      PropertyResult result;
      result.property = props::find_property(id);
      result.findings = std::move(findings);
      result.deciding = deciding_finding(result.findings);
      result.verdict = result.decisive().kind;
      report_.results.push_back(std::move(result));
    };
    add("fsm.determinism", {finding(VerdictKind::proved)});
    Finding broken = finding(VerdictKind::violated, "exact run");
    broken.counterexample = props::Counterexample{};
    broken.counterexample->reason = "two expiries <pending> & \"counted\"";
    add("timer.single-heartbeat", {finding(VerdictKind::proved), broken});
    add("live.completion", {finding(VerdictKind::inconclusive, "timelines")});
    context_.gate = judge(report_, scenario_.dds, {});
    context_.counterexamples.emplace("timer.single-heartbeat", "ce/timer.single-heartbeat.jsonl");
  }

  CheckReport report_;
  model::Scenario scenario_;
  CheckContext context_{"some-scenario", scenario_, {}, {}};
};

TEST_F(Reports, JsonHasAllKeysOfTheInterface) {
  const auto json = to_json(report_, context_);
  ASSERT_EQ(json["verdicts"].size(), 3U);
  for (const auto& verdict : json["verdicts"]) {
    for (const char* key : {"id", "verdict", "how", "assumptions", "seconds", "counterexample",
                            "solver", "seed", "findings"}) {
      EXPECT_TRUE(verdict.contains(key)) << key;
    }
  }
  EXPECT_EQ(json["verdicts"][0]["verdict"], "proved");
  EXPECT_TRUE(json["verdicts"][0]["counterexample"].is_null());
  EXPECT_EQ(json["verdicts"][1]["verdict"], "violated");
  EXPECT_EQ(json["verdicts"][1]["counterexample"], "ce/timer.single-heartbeat.jsonl");
  EXPECT_EQ(json["verdicts"][1]["findings"].size(), 2U);
  EXPECT_EQ(json["totals"]["inconclusive"], 1);
  EXPECT_EQ(json["totals"]["violated"], 1);
}

TEST_F(Reports, JUnitCountsAViolationAsFailureAndAnOpenQuestionAsError) {
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(to_junit(document_of(report_, context_)).c_str()),
            tinyxml2::XML_SUCCESS);
  const auto* suite = document.FirstChildElement("testsuites")->FirstChildElement("testsuite");
  EXPECT_EQ(suite->IntAttribute("tests"), 3);
  EXPECT_EQ(suite->IntAttribute("failures"), 1);
  EXPECT_EQ(suite->IntAttribute("errors"), 1);
  const auto* second = suite->FirstChildElement("testcase")->NextSiblingElement("testcase");
  EXPECT_STREQ(second->FirstChildElement("failure")->Attribute("message"),
               "two expiries <pending> & \"counted\"");
}

TEST_F(Reports, TextNamesVerdictAssumptionsAndTheFileToReplay) {
  const std::string text = to_text(document_of(report_, context_));
  EXPECT_NE(text.find("✗ violated  timer.single-heartbeat"), std::string::npos) << text;
  EXPECT_NE(text.find("assuming an assumption"), std::string::npos) << text;
  EXPECT_NE(text.find("stormproof replay ce/timer.single-heartbeat.jsonl"), std::string::npos);
  EXPECT_NE(
      document_of(report_, context_).subject.plain().find("1 violated, 1 inconclusive, 1 proved"),
      std::string::npos);
}

TEST(Catalogue, IdsAreUniqueAndEveryEntryIsComplete) {
  std::set<std::string_view> ids;
  for (const props::Property& property : props::catalogue()) {
    EXPECT_TRUE(ids.insert(property.id).second) << property.id;
    EXPECT_FALSE(property.statement.empty()) << property.id;
    EXPECT_FALSE(property.formal.empty()) << property.id;
    EXPECT_FALSE(property.source.empty()) << property.id;
    EXPECT_FALSE(property.engines.empty()) << property.id;
    EXPECT_EQ(props::find_property(property.id), &property);
  }
  EXPECT_EQ(ids.size(), 22U);
  EXPECT_EQ(props::find_property("no.such"), nullptr);
}

}  // namespace combination_test
}  // namespace stormproof::checker
