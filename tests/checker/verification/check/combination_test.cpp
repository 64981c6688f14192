// Which of several findings decides a property, and what the reports say about it.
#include "checker/verification/check/combination.hpp"

#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <tinyxml2.h>

#include "checker/presentation/document/render.hpp"
#include "checker/verification/check/check_report.hpp"

namespace stormproof::checker {
namespace combination_test {

using props::Finding;
using props::VerdictKind;

Finding finding(VerdictKind kind, std::string engine = "tables") {
  Finding result;
  result.kind = kind;
  result.engine = std::move(engine);
  result.how = "how";
  result.assumptions = {"an assumption"};
  return result;
}

VerdictKind verdict_of(const std::vector<Finding>& findings) {
  return findings[deciding_finding(findings)].kind;
}

TEST(Combination, TheStrongestVerdictThatHoldsDecides) {
  EXPECT_EQ(verdict_of({finding(VerdictKind::sampled), finding(VerdictKind::bounded)}),
            VerdictKind::bounded);
  EXPECT_EQ(verdict_of({finding(VerdictKind::bounded), finding(VerdictKind::proved)}),
            VerdictKind::proved);
  EXPECT_EQ(verdict_of({finding(VerdictKind::observed), finding(VerdictKind::sampled)}),
            VerdictKind::sampled);
  EXPECT_EQ(verdict_of({finding(VerdictKind::inconclusive), finding(VerdictKind::observed)}),
            VerdictKind::observed);
}

TEST(Combination, OneViolationOverrulesEveryProof) {
  EXPECT_EQ(verdict_of({finding(VerdictKind::proved), finding(VerdictKind::violated)}),
            VerdictKind::violated);
}

TEST(Combination, ADisputeOverrulesEverything) {
  for (const VerdictKind kind : props::verdict_kinds) {
    EXPECT_EQ(verdict_of({finding(kind), finding(VerdictKind::disputed)}), VerdictKind::disputed);
    EXPECT_EQ(verdict_of({finding(VerdictKind::disputed), finding(kind)}), VerdictKind::disputed);
  }
}

TEST(Combination, EveryKindHasANameAndAPlaceInReports) {
  std::set<std::string_view> names;
  for (const VerdictKind kind : props::verdict_kinds) names.insert(name_of(kind));
  EXPECT_EQ(names, (std::set<std::string_view>{"proved", "bounded", "sampled", "observed",
                                               "violated", "inconclusive", "disputed"}));
}

TEST(Combination, ATimeOutOfOneEngineDoesNotTakeAwayWhatAnotherEstablished) {
  EXPECT_EQ(verdict_of({finding(VerdictKind::inconclusive), finding(VerdictKind::bounded)}),
            VerdictKind::bounded);
}

TEST(Combination, OfEqualFindingsTheOneThatReachesFurtherDecides) {
  const Finding run = finding(VerdictKind::bounded, "exact run");
  const Finding explored = finding(VerdictKind::bounded, "explorer");
  EXPECT_EQ(deciding_finding({run, explored}), 1U);
  EXPECT_EQ(deciding_finding({explored, run}), 0U);
  EXPECT_EQ(deciding_finding({finding(VerdictKind::proved, "timelines"),
                              finding(VerdictKind::proved, "tables")}),
            1U);
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
  EXPECT_EQ(json["totals"]["disputed"], 0);
}

TEST_F(Reports, ADisputeIsWhatEveryFormatSaysFirst) {
  PropertyResult& result = report_.results.front();
  dispute(result.findings.front(), "another engine breaks it");
  result.verdict = VerdictKind::disputed;
  context_.gate = judge(report_, scenario_.dds, {});
  EXPECT_EQ(context_.gate.exit_code, 3);  // although something else is violated
  const report::Document document = document_of(report_, context_);
  EXPECT_EQ(document.exit_code, 3);
  const std::string text = to_text(document);
  EXPECT_EQ(text.find("✗ DISPUTED"), 0U) << text;
  EXPECT_NE(text.find("≠ disputed"), std::string::npos) << text;
  EXPECT_NE(to_junit(document).find("<error type=\"disputed\""), std::string::npos);
  const auto sarif = to_sarif(document);
  for (const auto& one : sarif["runs"][0]["results"]) {
    if (one["ruleId"] == "fsm.determinism") {
      EXPECT_EQ(one["level"], "error");
    }
  }
  const auto json = to_json(report_, context_);
  EXPECT_EQ(json["totals"]["disputed"], 1);
  EXPECT_EQ(json["gate"]["standings"]["disputed"], 1);
  EXPECT_EQ(json["verdicts"][0]["verdict"], "disputed");
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
  EXPECT_EQ(ids.size(), 29U);
  EXPECT_EQ(props::find_property("no.such"), nullptr);
}

}  // namespace combination_test
}  // namespace stormproof::checker
