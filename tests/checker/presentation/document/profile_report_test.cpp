// What `profile show` and `profile lint` say about a profile, and the words for what the model has
// not got.
#include "checker/verification/profile/profile_report.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "checker/presentation/document/render.hpp"
#include "checker/presentation/document/unmodelled.hpp"
#include "checker/presentation/text/paragraph.hpp"
#include "checker/presentation/text/source_line.hpp"
#include "checker/verification/profile/lint_report.hpp"

namespace stormproof::report {
namespace profile_report_test {

namespace config = model::config;

const config::SpecPath specs{{STORMPROOF_SPECS_DIR}};
const std::string folder = STORMPROOF_SOURCE_DIR "/tests/cli/profiles/";

ProfileReport described(const std::string& reference,
                        const std::vector<std::string>& overrides = {}) {
  const auto traced =
      config::trace_dds_profile(reference, overrides, specs, config::Outside::admitted);
  EXPECT_TRUE(traced) << to_string(traced.error());
  return traced ? describe_profile(*traced, specs) : ProfileReport{};
}

const KnobRow& row(const ProfileReport& report, const std::string& key) {
  static const KnobRow none{};
  for (const KnobRow& candidate : report.knobs) {
    if (candidate.key == key) return candidate;
  }
  ADD_FAILURE() << "no knob " << key;
  return none;
}

void expect_narrow(const std::string& text) {
  std::istringstream lines{text};
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(columns(line), report_width) << line;
  }
}

TEST(ProfileReport, every_knob_of_every_preset_has_its_evidence) {
  for (const std::string& name : specs.names(config::SpecKind::dds)) {
    const ProfileReport report = described(name);
    EXPECT_GT(report.knobs.size(), 14U) << name;
    for (const KnobRow& knob : report.knobs) {
      EXPECT_EQ(knob.origin.giver, Giver::preset) << name << " " << knob.key;
      EXPECT_FALSE(knob.origin.evidence.empty()) << name << " " << knob.key;
    }
    for (const UnmodelledRow& unmodelled : report.unmodelled) {
      EXPECT_FALSE(unmodelled.origin.evidence.empty()) << name << " " << unmodelled.setting;
    }
    expect_narrow(to_text(document_of(report)));
  }
}

TEST(ProfileReport, a_comment_goes_on_below_its_line) {
  const KnobRow knob = row(described("fastdds-2.6.11"), "spdp.resend");
  EXPECT_EQ(knob.origin.preset, "fastdds-2.6.11");
  EXPECT_EQ(knob.origin.evidence,
            "Fast DDS: PDPSimple.cpp:684-687 and StatelessWriter.cpp:633-657, multicast and every "
            "known participant");
}

TEST(ProfileReport, a_value_says_which_preset_of_the_chain_it_is_of) {
  const ProfileReport report = described("fastdds-3.6");
  EXPECT_EQ(report.preset, "fastdds-3.6");
  EXPECT_EQ(row(report, "sedp.piggyback").origin.preset, "fastdds-3.6");
  EXPECT_EQ(row(report, "spdp.resend").origin.preset, "fastdds-2.14.5");
  EXPECT_EQ(row(report, "spdp.period").origin.preset, "fastdds-2.6.11");
}

TEST(ProfileReport, a_vendors_file_is_told_from_its_preset) {
  const ProfileReport report = described(folder + "robots.xml");
  EXPECT_EQ(report.selected, "arm");
  const KnobRow period = row(report, "spdp.period");
  EXPECT_EQ(period.value, "7s");
  EXPECT_EQ(period.origin.giver, Giver::vendor);
  EXPECT_EQ(period.origin.place.line, 19);
  EXPECT_TRUE(period.origin.element.ends_with("/leaseAnnouncement")) << period.origin.element;
  ASSERT_TRUE(period.access);
  EXPECT_TRUE(period.access->changeable);
  const KnobRow delay = row(report, "sedp.nack_response_delay");
  EXPECT_EQ(delay.origin.giver, Giver::preset);
  ASSERT_TRUE(delay.access);
  EXPECT_FALSE(delay.access->changeable);
  EXPECT_FALSE(delay.access->why.empty());
}

TEST(ProfileReport, what_sets_no_knob_is_listed) {
  const ProfileReport report = described(folder + "robots.xml");
  const auto has = [&report](const std::string& path, config::vendor::Effect effect) {
    for (const auto& setting : report.others) {
      if (setting.path.find(path) != std::string::npos) return setting.effect == effect;
    }
    return false;
  };
  EXPECT_TRUE(has("receiveBufferSize", config::vendor::Effect::unmodelled));
  EXPECT_TRUE(has("heartbeatPeriod", config::vendor::Effect::none));
  EXPECT_FALSE(has("sendBufferSize", config::vendor::Effect::none));
  const std::string text = to_text(document_of(report));
  EXPECT_NE(text.find("receiveBufferSize"), std::string::npos);
  EXPECT_NE(text.find("heartbeatPeriod"), std::string::npos);
  const auto json = to_json(report);
  EXPECT_EQ(json["settings"].size(), report.others.size());
  EXPECT_EQ(json["knobs"].size(), report.knobs.size());
}

TEST(ProfileReport, users_files_and_arguments_are_named) {
  const ProfileReport report = described(folder + "lidar-slow.yaml", {"sedp.heartbeat_period=2s"});
  EXPECT_EQ(row(report, "sedp.heartbeat_period").origin.giver, Giver::override);
  EXPECT_EQ(row(report, "spdp.startup_announcements").origin.giver, Giver::file);
  EXPECT_EQ(row(report, "spdp.period").origin.giver, Giver::vendor);
  ASSERT_EQ(report.unmodelled.size(), 1U);
  EXPECT_EQ(report.unmodelled[0].setting, "traffic shaper");
  EXPECT_EQ(report.unmodelled[0].origin.giver, Giver::file);
  EXPECT_FALSE(row(described("paper"), "spdp.period").access);
}

TEST(LintReport, remarks_are_sorted_and_counted) {
  const std::vector<LintedFile> files{lint_profile(folder + "robots.xml", specs),
                                      lint_profile(folder + "server.xml", specs),
                                      lint_profile(folder + "lost.xml", specs)};
  int line = 0;
  for (const auto& remark : files[0].remarks) {
    EXPECT_GE(remark.place.line, line);
    line = remark.place.line;
  }
  const LintCounts counts = count(files);
  EXPECT_EQ(counts.errors, 1U);
  EXPECT_GE(counts.warnings, 1U);
  EXPECT_EQ(counts.unreadable, 1U);
  EXPECT_EQ(to_json(files)["files"][2]["remarks"].size(), 0U);
  EXPECT_FALSE(to_json(files)["files"][2]["error"].is_null());
}

TEST(LintReport, every_setting_that_the_model_has_not_got_is_a_remark) {
  const LintedFile robots = lint_profile(folder + "robots.xml", specs);
  const auto traced = config::trace_dds_profile(folder + "robots.xml", {}, specs);
  ASSERT_TRUE(traced);
  ASSERT_FALSE(traced->value.unmodelled.empty());
  for (const auto& [setting, effect] : traced->value.unmodelled) {
    const int line = traced->places.at("unmodelled." + setting).line;
    const auto is_there = [line](const auto& remark) { return remark.place.line == line; };
    EXPECT_TRUE(std::ranges::any_of(robots.remarks, is_there)) << setting;
  }
  const LintedFile preset = lint_profile("cyclonedds-0.10", specs);
  EXPECT_GT(preset.remarks.size(), 2U);
  EXPECT_EQ(preset.unmodelled_below, 0U);
}

TEST(SourceLine, the_caret_is_below_the_column) {
  EXPECT_EQ(marked_line("  <a>", 7, 3), "    7 |   <a>\n      |   ^\n");
  EXPECT_EQ(marked_line("\t<a>", 12, 2), "   12 |  <a>\n      |  ^\n");
  EXPECT_EQ(marked_line("ä<a>", 1, 3), "    1 | ä<a>\n      |  ^\n");
  EXPECT_EQ(marked_line("ab", 1, 99), "    1 | ab\n      |   ^\n");
  EXPECT_EQ(marked_line("\x1b[31mx", 1, 1), "    1 |  [31mx\n      | ^\n");
}

TEST(SourceLine, a_long_line_is_cut_around_its_column) {
  const std::string line = std::string(5'000, 'x') + "<a>" + std::string(5'000, 'y');
  const std::string marked = marked_line(line, 1, 5'001);
  expect_narrow(marked);
  const std::size_t caret = marked.rfind('^') - marked.rfind('\n', marked.rfind('^')) - 1;
  const std::string first = marked.substr(0, marked.find('\n'));
  EXPECT_EQ(first.find("<a>") - std::string{"…"}.size() + 1, caret);
  EXPECT_TRUE(SourceLines{}.marked({}).empty());
  const auto nowhere = std::make_shared<const std::string>("/no/such/file");
  EXPECT_TRUE(SourceLines{}.marked({nowhere, 1, 1}).empty());
}

TEST(SourceLine, lines_end_as_xml_says) {
  const std::string path = testing::TempDir() + "source_line.xml";
  const auto marked = [&](const std::string& text, int line, int column) {
    std::ofstream{path, std::ios::binary} << text;
    return SourceLines{}.marked({std::make_shared<const std::string>(path), line, column});
  };
  const std::string second = "    2 | <b>\n      | ^\n";
  EXPECT_EQ(marked("<a>\n<b>\n", 2, 1), second);
  EXPECT_EQ(marked("<a>\r\n<b>\r\n", 2, 1), second);
  EXPECT_EQ(marked("<a>\r<b>\r", 2, 1), second);
  EXPECT_EQ(marked("\xEF\xBB\xBF<a>", 1, 1), "    1 | <a>\n      | ^\n");
  EXPECT_EQ(marked("<a>\n", 3, 1), "");
  EXPECT_EQ(marked(std::string{"<\0a\0>\0", 6}, 1, 1), "");
  std::remove(path.c_str());
}

TEST(LintReport, settings_of_one_line_are_each_a_remark) {
  const std::string path = testing::TempDir() + "one_line.xml";
  std::ofstream{path} << "<CycloneDDS><Domain><General><AllowMulticast>false</AllowMulticast>"
                         "</General><Discovery><ParticipantIndex>auto</"
                         "ParticipantIndex><Peers><Peer Address='10.0.0.1:7410'/></Peers>"
                         "</Discovery></Domain></CycloneDDS>";
  const LintedFile linted = lint_profile(path, specs);
  EXPECT_EQ(std::ranges::count(linted.remarks, "unmodelled", &config::vendor::Remark::rule), 2);
  expect_narrow(to_text(document_of({linted})).substr(path.size()));
  std::ofstream{path} << "<CycloneDDS><Domain><General><AllowMulticast>spdp</AllowMulticast>"
                         "</General></Domain></CycloneDDS>";
  EXPECT_TRUE(lint_profile(path, specs).remarks.empty());
  std::remove(path.c_str());
}

TEST(LintReport, as_many_remarks_as_elements_are_no_trouble) {
  const std::string path = testing::TempDir() + "many.xml";
  std::string text = "<dds><profiles><participant profile_name='p'>";
  for (int k = 0; k < 20'000; ++k) text += "<nothing/>\n";
  std::ofstream{path} << text << "</participant></profiles></dds>";
  const LintedFile linted = lint_profile(path, specs);
  EXPECT_EQ(count({linted}).errors, 20'000U);
  EXPECT_NE(to_text(document_of({linted})).find("19999 | <nothing/>"), std::string::npos);
  std::remove(path.c_str());
}

TEST(Assumptions, are_named_or_not_at_all) {
  model::DdsProfile dds;
  Document document;
  add_unmodelled(document, dds);
  EXPECT_TRUE(document.assumptions.empty() && document.findings.empty());
  dds.unmodelled = {{"a", "one"}, {"b", std::string(300, 'w') + " two"}, {"c", "x"}, {"d", "y"}};
  add_unmodelled(document, dds, "robots.xml");
  EXPECT_TRUE(document.findings.empty()) << "nobody knows the lines";
  EXPECT_NE(to_text(document).find("\n  - a (not in the model, of robots.xml): one\n"),
            std::string::npos);
}

}  // namespace profile_report_test
}  // namespace stormproof::report
