// Markdown, SARIF and JUnit: what the formats demand, and that texts of users stay texts.
#include <cstdio>
#include <fstream>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <tinyxml2.h>

#include "checker/presentation/document/markdown.hpp"
#include "checker/presentation/document/render.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "tests/checker/presentation/document/examples.hpp"

namespace stormproof::report {
namespace formats_test {

using Json = nlohmann::ordered_json;

/// What SARIF 2.1.0 demands of a log with one run, as far as code scanning looks at it.
std::string sarif_fault(const Json& log) {
  const auto has = [](const Json& object, std::initializer_list<const char*> keys) {
    return std::ranges::all_of(keys, [&](const char* key) { return object.contains(key); });
  };
  if (!has(log, {"$schema", "version", "runs"}) || log["version"] != "2.1.0") return "log";
  const Json& run = log["runs"][0];
  if (!has(run, {"tool", "results", "invocations"})) return "run";
  const Json& driver = run["tool"]["driver"];
  if (!has(driver, {"name", "version", "rules"})) return "driver";
  if (!has(run["invocations"][0], {"executionSuccessful", "exitCode"})) return "invocation";
  std::set<std::string> rules;
  for (const Json& rule : driver["rules"]) {
    if (!has(rule, {"id", "shortDescription"})) return "rule";
    if (!rules.insert(rule["id"].get<std::string>()).second) return "rule twice";
  }
  const std::set<std::string> levels{"none", "note", "warning", "error"};
  std::set<std::string> fingerprints;
  for (const Json& result : run["results"]) {
    if (!has(result, {"ruleId", "ruleIndex", "level", "kind", "message", "locations",
                      "partialFingerprints"})) {
      return "result: " + result.dump();
    }
    const std::string rule = result["ruleId"];
    if (driver["rules"][result["ruleIndex"].get<std::size_t>()]["id"] != rule) return "rule index";
    if (!levels.contains(result["level"].get<std::string>())) return "level";
    if ((result["kind"] == "pass") != (result["level"] == "none")) return "kind and level";
    if (result["message"]["text"].get<std::string>().empty()) return "message";
    fingerprints.insert(result["partialFingerprints"].begin()->get<std::string>());
    if (result["locations"].empty()) return "no location";
    for (const Json& location : result["locations"]) {
      const Json& physical = location["physicalLocation"];
      const std::string uri = physical["artifactLocation"]["uri"];
      if (uri.empty() || uri.find(' ') != std::string::npos) return "uri " + uri;
      if (physical["region"]["startLine"] < 1) return "line";
    }
  }
  if (fingerprints.size() != run["results"].size()) return "two results with one fingerprint";
  return "";
}

const Json& result_of(const Json& log, const std::string& rule) {
  for (const Json& result : log["runs"][0]["results"]) {
    if (result["ruleId"] == rule) return result;
  }
  static const Json none;
  return none;
}

Json region_of(const Json& result) { return result["locations"][0]["physicalLocation"]["region"]; }

TEST(Sarif, OfACheckPointsAtTheKnobInTheUsersFile) {
  CheckExample example;
  const Json log = to_sarif(document_of(example.report(), example.context()));
  EXPECT_EQ(sarif_fault(log), "");
  EXPECT_NO_THROW(static_cast<void>(log.dump()));
  const Json& violated = result_of(log, "timer.single-heartbeat");
  EXPECT_EQ(violated["level"], "error");
  EXPECT_EQ(region_of(violated), (Json{{"startLine", 7}, {"startColumn", 22}}));
  EXPECT_EQ(violated["locations"][0]["physicalLocation"]["artifactLocation"]["uri"],
            "my%20robots.yaml");
  EXPECT_EQ(violated["relatedLocations"].size(), 1U);
  EXPECT_EQ(result_of(log, "live.completion")["level"], "warning");
  EXPECT_EQ(result_of(log, "fsm.determinism")["kind"], "pass");
  EXPECT_EQ(region_of(result_of(log, "fsm.determinism")), (Json{{"startLine", 1}}));
  EXPECT_EQ(result_of(log, "stormproof.unmodelled")["level"], "note");
  EXPECT_EQ(log["runs"][0]["invocations"][0]["exitCode"], 1);
}

TEST(Sarif, OfADiffPointsAtTheChangedKnobsOfTheCandidate) {
  const Json log = to_sarif(document_of(regression(), {}));
  EXPECT_EQ(sarif_fault(log), "");
  for (const char* rule : {"diff.verdict", "diff.cost", "diff.limit"}) {
    EXPECT_EQ(result_of(log, rule)["level"], "error") << rule;
    EXPECT_EQ(region_of(result_of(log, rule)), (Json{{"startLine", 12}, {"startColumn", 34}}))
        << rule;
  }
  EXPECT_EQ(result_of(log, "diff.margin")["level"], "warning");
  EXPECT_EQ(result_of(log, "diff.knob")["level"], "note");
  EXPECT_EQ(log["runs"][0]["invocations"][0]["exitCode"], 1);
  EXPECT_EQ(to_sarif(document_of(equality(), {}))["runs"][0]["results"].size(), 0U);
}

TEST(Sarif, TheCheckNoticesWhatIsMissing) {
  Json log = to_sarif(document_of(regression(), {}));
  log["runs"][0]["results"][0].erase("message");
  EXPECT_NE(sarif_fault(log), "");
  log = to_sarif(document_of(regression(), {}));
  log["runs"][0]["results"][0]["ruleIndex"] = 3;
  EXPECT_NE(sarif_fault(log), "");
}

TEST(Sarif, FingerprintsStayWhenNumbersChange) {
  diff::DiffReport report = regression();
  const Json before = to_sarif(document_of(report, {}));
  report.costs.configurations[1].measures[0].reason = "another number";
  const Json after = to_sarif(document_of(report, {}));
  EXPECT_NE(result_of(before, "diff.cost")["message"], result_of(after, "diff.cost")["message"]);
  EXPECT_EQ(result_of(before, "diff.cost")["partialFingerprints"],
            result_of(after, "diff.cost")["partialFingerprints"]);
}

TEST(Sarif, PathsBecomeUris) {
  EXPECT_EQ(uri_of("./a b/c#d.xml"), "a%20b/c%23d.xml");
  EXPECT_EQ(uri_of("/no such/place.xml"), "file:///no%20such/place.xml");
  EXPECT_EQ(uri_of("größe.yaml"), "gr%C3%B6%C3%9Fe.yaml");
  EXPECT_EQ(uri_of("a:b.yaml"), "a%3Ab.yaml");
}

TEST(Sarif, ColumnsCountCharacters) {
  const std::string file = testing::TempDir() + "stormproof-columns.yaml";
  std::ofstream{file} << "first\nkey: {größe: 1, value: 2}\n";
  Document document;
  Finding& finding = document.findings.emplace_back();
  finding.id = "r";
  finding.message = "m";
  Location& at = finding.locations.emplace_back();
  at.file = file;
  at.line = 2;
  at.column = 27;  // of "2", in bytes
  EXPECT_EQ(region_of(to_sarif(document)["runs"][0]["results"][0]),
            (Json{{"startLine", 2}, {"startColumn", 25}}));
  std::remove(file.c_str());
}

TEST(JUnit, CountsRegressionsAsFailuresAndWhatIsUnclearAsErrors) {
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(to_junit(document_of(regression(), {})).c_str()), tinyxml2::XML_SUCCESS);
  const auto* suite = document.FirstChildElement("testsuites")->FirstChildElement("testsuite");
  EXPECT_EQ(suite->IntAttribute("tests"), 6);
  EXPECT_EQ(suite->IntAttribute("failures"), 3);
  EXPECT_EQ(suite->IntAttribute("errors"), 1);
  EXPECT_EQ(std::string{suite->Attribute("name")}.find('\xff'), std::string::npos);
  CheckExample example;
  ASSERT_EQ(document.Parse(to_junit(document_of(example.report(), example.context())).c_str()),
            tinyxml2::XML_SUCCESS);
}

TEST(JUnit, HoldsWhatXmlCannot) {
  Document hostile;
  hostile.title = "a\x01 <b>";
  Finding& finding = hostile.findings.emplace_back();
  finding.group = "c";
  finding.name = "n\xff\" '";
  finding.outcome = Finding::Outcome::failed;
  finding.details = "]]> & \x1b[31m";
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(to_junit(hostile).c_str()), tinyxml2::XML_SUCCESS);
  const auto* element = document.FirstChildElement("testsuites")->FirstChildElement("testsuite");
  EXPECT_STREQ(element->Attribute("name"), "a <b>");
  const auto* test = element->FirstChildElement("testcase");
  EXPECT_STREQ(test->Attribute("name"), "n\xef\xbf\xbd\" '");
  EXPECT_STREQ(test->FirstChildElement("failure")->GetText(), "]]> & [31m");
}

TEST(Markdown, NothingOfAUserFormatsMentionsOrIsHtml) {
  EXPECT_EQ(md_text("a|b `c` <d> *e* _f_"), "a\\|b \\`c\\` &lt;d&gt; \\*e\\* \\_f\\_");
  EXPECT_EQ(md_text("@team #1\nnext"), "@<!-- -->team #<!-- -->1 next");
  EXPECT_EQ(md_code("a`b|c"), "``a`b\\|c``");
  EXPECT_EQ(md_code("`"), "`` ` ``");
  EXPECT_EQ(md_code(""), "–");
  EXPECT_EQ(md_block("text", "a\n```\nb"), "````text\na\n```\nb\n````\n");
  for (const std::string& text :
       {to_markdown(document_of(regression(), {})), [] {
          CheckExample example;
          return to_markdown(document_of(example.report(), example.context()));
        }()}) {
    EXPECT_EQ(text.find('\xff'), std::string::npos);
    EXPECT_EQ(text.find(" @team #1 &amp;"), std::string::npos);
    EXPECT_LE(text.size(), markdown_bytes);
    EXPECT_EQ(occurrences(text, "<details>"), occurrences(text, "</details>"));
    EXPECT_GE(occurrences(text, "```mermaid\nsequenceDiagram\n"), 2U);
  }
}

TEST(Markdown, TablesKeepTheirColumnsWhateverTheCellsSay) {
  std::istringstream lines{to_markdown(document_of(regression(), {}))};
  std::size_t rows = 0;
  std::size_t columns = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() != '|') {
      columns = 0;
      continue;
    }
    std::size_t bars = 0;
    for (std::size_t k = 0; k < line.size(); ++k) {
      bars += line[k] == '|' && (k == 0 || line[k - 1] != '\\') ? 1U : 0U;
    }
    if (columns == 0) columns = bars;
    EXPECT_EQ(bars, columns) << line;
    ++rows;
  }
  EXPECT_GE(rows, 12U);
}

TEST(Markdown, OfADiffSaysTheJudgmentFirst) {
  const std::string text = to_markdown(document_of(regression(), {}));
  EXPECT_EQ(text.find("### stormproof diff "), 0U);
  EXPECT_LT(text.find("❌ REGRESSION"), text.find('\n'));
  EXPECT_LT(text.find("worse"), text.find("#### Knobs that differ"));
  EXPECT_NE(text.find("| ❌ regression | `storm.free-threshold` | proved | violated |"),
            std::string::npos);
  EXPECT_NE(to_markdown(document_of(equality(), {})).find("✅ NO REGRESSION"), std::string::npos);
}

TEST(Markdown, ACommentHasAMarkAndBars) {
  const std::string markdown = to_markdown(document_of(regression(), {}));
  const std::string comment = to_comment(document_of(regression(), {}), "diff");
  EXPECT_EQ(comment.find("<!-- stormproof diff -->\n### stormproof diff "), 0U);
  EXPECT_EQ(markdown.find("█"), std::string::npos);
  // The longest of four bars fills its cell, and stands above everything that is folded.
  EXPECT_EQ(occurrences(comment, "| base | 2.000 s | "), 2U) << comment;
  std::string longest;
  for (int k = 0; k < 24; ++k) longest += "█";
  EXPECT_EQ(occurrences(comment, "|  | candidate | 5.000 s | " + longest + " |"), 1U) << comment;
  EXPECT_LT(comment.find(longest), comment.find("<details>"));
}

TEST(Markdown, WhatIsTooLongForACommentIsLeftOutAndNamed) {
  MarkdownDocument document;
  document.add("", "always\n");
  document.add("the first part", std::string(30'000, 'a'));
  document.add("the second part", std::string(40'000, 'b'));
  document.add("the third part", "short\n");
  const std::string text = document.text("Elsewhere.");
  EXPECT_LE(text.size(), markdown_bytes);
  EXPECT_NE(text.find("always"), std::string::npos);
  EXPECT_NE(text.find("aaa"), std::string::npos);
  EXPECT_EQ(text.find("bbb"), std::string::npos);
  EXPECT_NE(text.find("short"), std::string::npos);
  EXPECT_NE(text.find("Left out to fit into a comment: the second part. Elsewhere."),
            std::string::npos);
}

TEST(PlainText, ReplacesWhatIsNoTextAndQuotesForTheShell) {
  EXPECT_EQ(valid_text("a\xff\xc3\xa4\x01\n"), "a\xef\xbf\xbd\xc3\xa4\n");
  EXPECT_EQ(valid_text("\xc0\xaf"), "\xef\xbf\xbd\xef\xbf\xbd");
  EXPECT_EQ(valid_text("\xed\xa0\x80"), "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd");
  EXPECT_EQ(valid_text("a\xe2\x80\xae"
                       "b"),
            "ab");
  EXPECT_EQ(one_line("  a\n\t b "), "a b");
  EXPECT_EQ(shell_word("a=b"), "a=b");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word(""), "''");
}

}  // namespace formats_test
}  // namespace stormproof::report
