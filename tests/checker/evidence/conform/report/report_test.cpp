// The reports of a conformance check: what people are told first, what scripts rely on, and that
// nothing from a capture becomes markup.
#include "checker/evidence/conform/report/report.hpp"

#include <set>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "checker/evidence/conform/report/chart.hpp"
#include "checker/evidence/conform/report/findings.hpp"
#include "checker/evidence/conform/report/names.hpp"
#include "checker/presentation/document/render.hpp"
#include "checker/presentation/text/paragraph.hpp"
#include "model/config/tree/quantities.hpp"
#include "tests/checker/evidence/conform/report/results.hpp"
#include "tests/files.hpp"

namespace stormproof::conform {

namespace report_test {

using namespace testing;
using Json = nlohmann::ordered_json;
using report::to_html;
using report::to_junit;
using report::to_markdown;
using report::to_sarif;

std::string text_of(const Report& report) { return report::to_text(document_of(report)); }

TEST_F(Reports, TheConversationIsTheOneThatResultsAreAbout) {
  ASSERT_EQ(conversation.events.size(), 7U);
  EXPECT_NE(conversation.events[2].heartbeat(), nullptr);
  EXPECT_NE(conversation.events[3].acknack(), nullptr);
  EXPECT_NE(conversation.events[5].data(), nullptr);
  EXPECT_EQ(conversation.topology.hosts, 2U);
}

TEST_F(Reports, TheFirstLineHasVerdictProfileAndBounds) {
  const std::string bounds =
      " fastdds-2.6.11 within these bounds: delay 0 to 60s, send lag up to 20ms, timers up to "
      "500ms late, clock up to 0 old, same host done within 0, clocks equal, losses allowed";
  const auto answer = [&](const Conformance& result) {
    return document_of(report_of(result)).answer.plain();
  };
  EXPECT_EQ(answer(good), "CONFORMS to" + bounds);
  EXPECT_EQ(answer(bad), "DOES NOT CONFORM to" + bounds);
  EXPECT_EQ(answer(open), "INCONCLUSIVE for" + bounds);
  good.bounds = {1'000, 2'000, 3'000, 4'000, 5'000, 6'000, 7'000, false};
  EXPECT_TRUE(has(answer(good),
                  "delay 1us to 2us, send lag up to 3us, timers up to 4us late, clock up to 5us "
                  "old, same host done within 6us, clocks up to 7us apart, no losses"));
}

TEST_F(Reports, ConformanceIsNotCalledAProof) {
  const std::string text = text_of(report_of(good));
  EXPECT_TRUE(has(text, "it is no proof"));
  EXPECT_FALSE(has(text, "no assignment explains"));
  EXPECT_FALSE(has(text, "tshark"));
  EXPECT_TRUE(has(text, "datagrams taken as lost"));
  EXPECT_TRUE(has(text, "1.500000 ms   20.000000 ms"));
  EXPECT_TRUE(has(text, "(an assumption)"));
  EXPECT_TRUE(has(text, "caused on their own host"));
}

TEST_F(Reports, AnInconclusiveResultSaysWhy) {
  open.undecided = 3;
  open.not_replayed = 4;
  const std::string text = text_of(report_of(open));
  EXPECT_TRUE(has(text, "Interrupted. No event"));
  EXPECT_FALSE(has(text, "it is no proof"));
  EXPECT_TRUE(has(text, "relations given up "));
  EXPECT_TRUE(has(text, "explanations not confirmed by the machines "));
  EXPECT_FALSE(has(text_of(report_of(good)), "given up"));
}

TEST_F(Reports, TheFirstUnexplainedEventIsNamedCompletely) {
  const std::string text = text_of(report_of(bad));
  EXPECT_TRUE(has(text, "relation 0 → 1 (publications)"));
  EXPECT_TRUE(has(text, "2.500000 ms after the first packet, datagram 3, packet 4 of 0.pcap"));
  EXPECT_TRUE(has(text, "from     participant 1 (host 1"));
  EXPECT_TRUE(has(text, "to       participant 0 (host 0"));
  EXPECT_TRUE(has(text, std::string{rule_broken_by(Fault::acknack_early)}.substr(0, 40)));
  EXPECT_TRUE(has(text, "nearest  the HEARTBEAT arrives at once"));
  EXPECT_TRUE(has(text, "send lag 30ms (bound 20ms)"));
  EXPECT_TRUE(has(text, "needs    a HEARTBEAT before it\n"));
  EXPECT_TRUE(has(text, "tshark -r 0.pcap -Y 'frame.number == 4'"));
}

TEST_F(Reports, LinesFitATerminal) {
  for (const Conformance* result : {&good, &bad, &open}) {
    std::istringstream lines{text_of(report_of(*result))};
    std::string line;
    while (std::getline(lines, line)) EXPECT_LE(report::columns(line), 100U) << line;
  }
}

TEST_F(Reports, FaultsAreGrouped) {
  const auto groups = by_fault(bad);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].fault, Fault::acknack_early);
  bad.unexplained.push_back(bad.unexplained[0]);
  EXPECT_EQ(by_fault(bad)[0].places, 2U);
  EXPECT_EQ(by_fault(bad)[0].first, bad.unexplained.data());
  for (std::size_t k = 0; k < fault_count; ++k) {
    bad.unexplained.push_back(bad.unexplained[0]);
    bad.unexplained.back().fault = static_cast<Fault>(k);
  }
  EXPECT_EQ(by_fault(bad).size(), fault_count);
  for (const FaultGroup& group : by_fault(bad)) {
    EXPECT_TRUE(has(text_of(report_of(bad)), name_of(group.fault)));
  }
}

TEST_F(Reports, CompressedCapturesAreUnpackedForTshark) {
  conversation.captures[0].name = "my run.pcap.xz";
  EXPECT_TRUE(has(text_of(report_of(bad)), "xz -dc 'my run.pcap.xz' | tshark -r - "));
}

TEST_F(Reports, PagesEscapeWhatTheCaptureSays) {
  conversation.topology.participants[0].name = "<b>@all|";
  bad.unexplained[0].what = "<b>@all|";
  const std::string html = to_html(document_of(report_of(bad)));
  EXPECT_FALSE(has(html, "<b>@all"));
  EXPECT_TRUE(has(html, "DOES NOT CONFORM"));
  EXPECT_TRUE(has(html, "<svg"));
  const std::string markdown = to_markdown(document_of(report_of(bad)));
  EXPECT_TRUE(has(markdown, "DOES NOT CONFORM"));
  const std::string table = markdown.substr(0, markdown.find("```"));
  EXPECT_FALSE(has(table, "<b>"));
}

TEST_F(Reports, JUnitHasACaseForEachPlace) {
  const std::string failed = to_junit(document_of(report_of(bad)));
  EXPECT_EQ(times(failed, "<testcase"), 2U);
  EXPECT_EQ(times(failed, "<failure"), 2U);
  EXPECT_TRUE(has(failed, "type=\"acknack_early\""));
  const std::string passed = to_junit(document_of(report_of(good)));
  EXPECT_EQ(times(passed, "<testcase"), 2U);
  EXPECT_EQ(times(passed, "<failure"), 0U);
  EXPECT_EQ(times(to_junit(document_of(report_of(open))), "<error"), 1U);
}

TEST_F(Reports, SarifHasAResultForEachUnexplainedEvent) {
  const Json run = to_sarif(document_of(report_of(bad))).at("runs")[0];
  ASSERT_EQ(run.at("results").size(), 2U);
  EXPECT_EQ(run.at("results")[0].at("ruleId"), "conform.acknack_early");
  EXPECT_EQ(to_sarif(document_of(report_of(good))).at("runs")[0].at("results").size(), 0U);
  const Json unknown = to_sarif(document_of(report_of(open))).at("runs")[0].at("results");
  ASSERT_EQ(unknown.size(), 1U);
  EXPECT_EQ(unknown[0].at("ruleId"), "conform.inconclusive");
}

TEST_F(Reports, JsonHasTheFirstUnexplainedEvent) {
  const Json json = to_json(report_of(bad));
  EXPECT_EQ(json.at("verdict"), "does_not_conform");
  EXPECT_EQ(json.at("bounds").at("most_delay_ns"), 60'000'000'000);
  EXPECT_EQ(json.at("bounds_used").at("send_lag_ns"), 1'500'000);
  const Json& first = json.at("unexplained")[0];
  EXPECT_EQ(first.at("event"), 3);
  EXPECT_EQ(first.at("packet"), 4);
  EXPECT_EQ(first.at("capture"), "0.pcap");
  EXPECT_EQ(first.at("source"), 1);
  EXPECT_EQ(first.at("destination"), 0);
  EXPECT_EQ(first.at("time_ns"), conversation.first_ns + 2'500'000);
  EXPECT_EQ(first.at("fault"), "acknack_early");
  EXPECT_EQ(first.at("place").at("destination"), 1);
  EXPECT_EQ(first.at("needs")[0].at("needed_ns"), 30'000'000);
  EXPECT_TRUE(first.at("needs")[1].at("bound_ns").is_null());
  EXPECT_EQ(first.at("context").size(), 3U);
  EXPECT_TRUE(json.at("unexplained")[1].at("place").at("destination").is_null());
  EXPECT_EQ(json.at("faults").at("announcement_extra"), 1);
  EXPECT_EQ(json.at("rules").size(), rule_count);
  EXPECT_EQ(to_json(report_of(open)).at("why_inconclusive"), open.why_inconclusive);
}

TEST_F(Reports, JsonTakesNamesThatAreNoUtf8) {
  conversation.topology.participants[0].name = "\xff";
  conversation.captures[0].name = "\xfe.pcap";
  EXPECT_NO_THROW((void)to_json(report_of(bad)).dump());
  EXPECT_FALSE(has(text_of(report_of(bad)), "\xff"));
}

TEST_F(Reports, TheAssignmentHasALineForEachHiddenEvent) {
  std::istringstream lines{assignment_lines(report_of(bad))};
  std::vector<Json> events;
  for (std::string line; std::getline(lines, line);) events.push_back(Json::parse(line));
  ASSERT_EQ(events.size(), 1 + bad.hidden.size());
  EXPECT_EQ(events[0].at("format"), "stormproof-assignment");
  EXPECT_EQ(events[0].at("verdict"), "does_not_conform");
  EXPECT_EQ(events[1].at("machine"), "Announcer");
  EXPECT_EQ(events[2].at("kind"), "received");
  EXPECT_EQ(events[2].at("packet"), 3);
  EXPECT_EQ(
      events[2].at("time_ns").get<std::int64_t>() - events[2].at("sent_ns").get<std::int64_t>(),
      1'000'000);
}

/// Keys of objects at any depth, without those that are names of rules or faults.
void collect_keys(const Json& json, std::set<std::string>& keys) {
  if (json.is_array()) {
    for (const Json& element : json) collect_keys(element, keys);
  }
  if (!json.is_object()) return;
  for (const auto& [key, value] : json.items()) {
    keys.insert(key);
    if (key != "rules" && key != "faults" && key != "unmodelled") collect_keys(value, keys);
  }
}

std::string documentation() {
  return files::content(STORMPROOF_SOURCE_DIR "/specs/guide/conforming.md");
}

TEST_F(Reports, EveryKeyIsDocumented) {
  dds.unmodelled["setting"] = "effect";
  std::set<std::string> keys;
  for (const Conformance* result : {&good, &bad, &open}) {
    collect_keys(to_json(report_of(*result)), keys);
    std::istringstream lines{assignment_lines(report_of(*result))};
    for (std::string line; std::getline(lines, line);) collect_keys(Json::parse(line), keys);
  }
  ASSERT_GT(keys.size(), 40U);
  const std::string text = documentation();
  for (const std::string& key : keys) EXPECT_TRUE(has(text, "`" + key + "`")) << key;
  EXPECT_FALSE(has(text, "`no_such_key`"));
}

TEST(Documentation, HasTheDefaultsOfTheBounds) {
  const std::string text = documentation();
  const auto printed = [](std::int64_t ns) {
    return ns == 0 ? "0" : model::config::print_duration(model::Nanoseconds{ns});
  };
  const Bounds bounds;
  EXPECT_TRUE(has(text, "| `--delay LO..HI` | `" + printed(bounds.least_delay_ns) + ".." +
                            printed(bounds.most_delay_ns) + "` |"));
  EXPECT_TRUE(has(text, "| `--send-lag D` | `" + printed(bounds.most_send_lag_ns) + "` |"));
  EXPECT_TRUE(has(text, "| `--lateness D` | `" + printed(bounds.most_lateness_ns) + "` |"));
  EXPECT_TRUE(has(text, "| `--clock-age D` | `" + printed(bounds.most_clock_age_ns) + "` |"));
  EXPECT_TRUE(has(text, "| `--same-host D` | `" + printed(bounds.most_same_host_ns) + "` |"));
  EXPECT_TRUE(has(text, "| `--queueing D` | `" + printed(bounds.most_queueing_ns) + "` |"));
  EXPECT_TRUE(has(text, "| `--clock-error D` | `" + printed(bounds.clock_error_ns) + "` |"));
}

TEST(Documentation, HasEveryRuleAndFaultWithItsSentence) {
  const std::string text = documentation();
  for (std::size_t k = 0; k < rule_count; ++k) {
    const auto rule = static_cast<Rule>(k);
    EXPECT_TRUE(
        has(text, "| `" + std::string{name_of(rule)} + "` | " + std::string{statement_of(rule)}))
        << name_of(rule);
  }
  for (std::size_t k = 0; k < fault_count; ++k) {
    const auto fault = static_cast<Fault>(k);
    EXPECT_TRUE(has(
        text, "| `" + std::string{name_of(fault)} + "` | " + std::string{rule_broken_by(fault)}))
        << name_of(fault);
  }
}

}  // namespace report_test
}  // namespace stormproof::conform
