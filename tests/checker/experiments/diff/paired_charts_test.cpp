// The two charts as one drawing: well-formed, with both names, and with what makes the difference.
#include "checker/experiments/diff/paired_charts.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "checker/experiments/diff/telling_apart.hpp"
#include "checker/verification/counterexample/chart.hpp"
#include "tests/checker/presentation/diagrams/svg_texts.hpp"

namespace stormproof::diff {
namespace paired_charts_test {

using model::DdsProfile;

TellingApart told(const DdsProfile& base, const DdsProfile& candidate) {
  model::Scenario start;
  start.deployment = model::Deployment::homogeneous(2, 1, 0);
  return tell_apart(start, base, candidate, {});
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

/// The two drawings inside the document.
struct Parts {
  draw::SvgTexts above, below;
};

std::optional<Parts> parts_of(const std::string& document) {
  if (!draw::read_svg(document)) return std::nullopt;  // the whole is well-formed, too
  const std::string begin = "<svg x=";
  const std::size_t first = document.find(begin);
  const std::size_t second = document.find(begin, first + 1);
  if (second == std::string::npos) return std::nullopt;
  const auto part = [&](std::size_t at) {
    return draw::read_svg(document.substr(at, document.find("</svg>", at) + 6 - at));
  };
  const auto above = part(first);
  const auto below = part(second);
  if (!above || !below) return std::nullopt;
  return Parts{*above, *below};
}

TEST(PairedCharts, OneDrawingWithBothRuns) {
  DdsProfile slow;
  slow.sedp.heartbeat_response_delay = model::Nanoseconds{10'000'000};
  const TellingApart apart = told({}, slow);
  const std::string document = paired_charts_svg(apart, "paper", "slow <1> & \"co\"");
  const auto parts = parts_of(document);
  ASSERT_TRUE(parts);
  EXPECT_TRUE(parts->above.says("≠ Base: paper"));
  EXPECT_TRUE(parts->below.says("≠ Candidate: slow <1> & \"co\""));
  EXPECT_EQ(parts->above.count("≠ Here the runs part"), 1U);
  EXPECT_EQ(parts->below.count("≠ Here the runs part"), 1U);
  EXPECT_TRUE(parts->above.says("≠45"));
  EXPECT_TRUE(parts->above.says("sends p14 ACKNACK 1→0 pub, lacks 0–8"));
  EXPECT_TRUE(parts->below.says("sends p14 ACKNACK 1→0 pub, lacks nothing"));
  EXPECT_EQ(parts->above.fault(), "");
  EXPECT_EQ(parts->below.fault(), "");
  EXPECT_EQ(document.find("violated"), std::string::npos);
  EXPECT_EQ(document.find("✗"), std::string::npos);
}

TEST(PairedCharts, EveryIdOnce) {
  DdsProfile candidate;
  candidate.spdp.resend = model::SpdpResend::none;
  const std::string document = paired_charts_svg(told({}, candidate));
  EXPECT_EQ(count_of(document, "<style>"), 1U);
  EXPECT_EQ(count_of(document, "<defs>"), 1U);
  EXPECT_EQ(count_of(document, " id=\"arrow\""), 1U);
  EXPECT_EQ(count_of(document, " id="), count_of(document, "<marker "));
  EXPECT_EQ(count_of(document, "prefers-color-scheme: dark"), 1U);
  EXPECT_EQ(count_of(document, "<svg "), 3U);
  EXPECT_EQ(count_of(document, "</svg>"), 3U);
  EXPECT_EQ(count_of(document, "http"), 1U) << "the name space, and nothing from outside";
}

TEST(PairedCharts, OneAboveTheOther) {
  DdsProfile candidate;
  candidate.sedp.initial_data = model::InitialData::pull;
  const TellingApart apart = told({}, candidate);
  const std::string document = paired_charts_svg(apart);
  const auto whole = draw::read_svg(document);
  const auto parts = parts_of(document);
  ASSERT_TRUE(whole && parts);
  EXPECT_TRUE(parts->above.says("≠ Base"));
  EXPECT_TRUE(parts->below.says("≠ Candidate"));
  EXPECT_EQ(whole->height, parts->above.height + parts->below.height);
  EXPECT_EQ(whole->width, std::max(parts->above.width, parts->below.width));
  const std::string place = "<svg x=\"0\" y=\"" + std::to_string(parts->above.height) + "\"";
  EXPECT_NE(document.find(place), std::string::npos);
}

TEST(PairedCharts, ShowsThePacketThatDiffersWhateverItIs) {
  DdsProfile candidate;
  candidate.spdp.resend = model::SpdpResend::new_only;
  const TellingApart apart = told({}, candidate);
  ASSERT_EQ(apart.base_packets.size(), 1U);
  const std::string document = paired_charts_svg(apart);
  EXPECT_NE(document.find("sends p2 SPDP 1→all"), std::string::npos);
  EXPECT_NE(document.find("sends p2 SPDP 1→0"), std::string::npos);
  // Sent by participant 1, whose texts stand right of its lane, and not by participant 0.
  const counterexample::Chart chart = counterexample::chart_of(apart.base_run, apart.base_packets);
  bool found = false;
  for (const auto& line : chart.rows.back().lines) {
    if (line.text.find("SPDP 1→all") == std::string::npos) continue;
    EXPECT_EQ(chart.lanes.at(line.lane).title, "participant 1");
    found = true;
  }
  EXPECT_TRUE(found);
}

TEST(PairedCharts, FoldWhatBothRunsBeginWith) {
  DdsProfile slow;
  slow.sedp.heartbeat_response_delay = model::Nanoseconds{10'000'000};
  const TellingApart apart = told({}, slow);
  const PairedCharts whole = paired_charts(apart, "", "", CommonStart::in_base);
  const PairedCharts folded = paired_charts(apart, "", "", CommonStart::nowhere);
  EXPECT_GT(whole.base.rows.size(), folded.base.rows.size());
  EXPECT_EQ(whole.candidate.rows.size(), folded.candidate.rows.size());
  EXPECT_EQ(folded.base.rows.front().text.substr(0, 21), "both runs do the same");
  EXPECT_TRUE(folded.base.rows.back().violation);
  EXPECT_EQ(sequence::common_rows(folded.base, folded.candidate), 4U)
      << "the gap, and three rows before the runs part";
}

TEST(PairedCharts, NothingForProfilesThatCannotBeToldApart) {
  EXPECT_TRUE(paired_charts_svg(told({}, {})).empty());
}

}  // namespace paired_charts_test
}  // namespace stormproof::diff
