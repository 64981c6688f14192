// The chart of an unexplained event and the names in it.
#include "checker/evidence/conform/report/chart.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "checker/evidence/conform/report/names.hpp"
#include "tests/checker/evidence/conform/report/results.hpp"
#include "tests/checker/presentation/diagrams/svg_texts.hpp"

namespace stormproof::conform {

namespace chart_test {

using namespace testing;

using sequence::Chart;
using LineKind = Chart::Line::Kind;

/// The lines of a kind, by row.
std::vector<std::pair<std::size_t, Chart::Line>> lines_of(const Chart& chart, LineKind kind) {
  std::vector<std::pair<std::size_t, Chart::Line>> found;
  for (std::size_t r = 0; r < chart.rows.size(); ++r) {
    for (const Chart::Line& line : chart.rows[r].lines) {
      if (line.kind == kind) found.emplace_back(r, line);
    }
  }
  return found;
}

TEST_F(Reports, TheChartMarksTheUnexplainedEvent) {
  const Chart chart = chart_of(report_of(bad), bad.unexplained[0]);
  const auto sent = lines_of(chart, LineKind::sent);
  const auto received = lines_of(chart, LineKind::received);
  const auto lost = lines_of(chart, LineKind::lost);
  ASSERT_EQ(sent.size(), 3U);
  EXPECT_EQ(sent[0].second.lane, 0U);
  EXPECT_EQ(sent[1].second.lane, 2U);
  EXPECT_EQ(sent[1].second.text, "ACKNACK 1 for publications: has nothing, asks for 1–2");
  EXPECT_TRUE(chart.rows[sent[1].first].violation);
  EXPECT_EQ(std::ranges::count(chart.rows, true, &Chart::Row::violation), 1);
  ASSERT_EQ(received.size(), 2U);
  EXPECT_EQ(received[0].second.packets, sent[0].second.packets);
  EXPECT_EQ(chart.rows[received[0].first].time.count(), 2'000'000);
  EXPECT_EQ(received[1].second.packets, sent[1].second.packets);
  EXPECT_EQ(received[1].second.text, "packet 4 arrives, is dropped: not open yet");
  ASSERT_EQ(lost.size(), 1U);
  EXPECT_EQ(lost[0].second.packets, sent[2].second.packets);
}

TEST_F(Reports, TheChartAsText) {
  const std::string text = text_chart(chart_of(report_of(bad), bad.unexplained[0]));
  EXPECT_EQ(times(text, "✗"), 1U);
  EXPECT_TRUE(has(text, "✗        2.500000        4   │◁")) << text;
  EXPECT_TRUE(has(text, "not explained │")) << text;
  EXPECT_TRUE(has(text, "         2.000000        3   │")) << text;
  EXPECT_TRUE(has(text, "packet 3 arrives │")) << text;
  EXPECT_EQ(times(text, "╳│"), 1U) << text;
  EXPECT_TRUE(has(text, "is lost")) << text;
  EXPECT_FALSE(has(text, "dashed")) << text;
}

TEST_F(Reports, SubmessagesOfOneDatagramAreOneArrow) {
  bad.unexplained[0].context = {2, 3, 4, 5, 6};
  const Chart chart = chart_of(report_of(bad), bad.unexplained[0]);
  const auto sent = lines_of(chart, LineKind::sent);
  ASSERT_EQ(sent.size(), 4U);
  EXPECT_EQ(sent[2].second.text, "DATA 1–2 of publications");
  EXPECT_TRUE(chart.packets[sent[2].second.packets[0]].lost);
  EXPECT_EQ(sent[3].second.text, "ACKNACK 2 for publications: has 1–2");
}

TEST_F(Reports, AFateThatNobodyKnowsIsADashedArrow) {
  bad.unexplained[0].context = {2, 3, 4, 5, 6};
  bad.hidden.push_back({Hidden::Kind::still_under_way, 0, 6, announcements, {}});  // elsewhere
  Chart chart = chart_of(report_of(bad), bad.unexplained[0]);
  EXPECT_EQ(chart.packets.back().unknown_end, 0U);
  EXPECT_TRUE(has(text_chart(chart), "│◁╌╌"));
  const std::string legend = "dashed arrows: nobody knows whether the packet arrives";
  EXPECT_TRUE(has(text_chart(chart), legend));
  EXPECT_TRUE(has(svg_chart(chart), legend));
  EXPECT_EQ(times(svg_chart(chart), "class=\"packet unknown"), 1U);
  EXPECT_TRUE(has(mermaid_chart(chart), "L2-->>L0: "));
  bad.hidden.back().place = publications;
  chart = chart_of(report_of(bad), bad.unexplained[0]);
  EXPECT_FALSE(chart.packets.back().unknown_end.has_value());
  EXPECT_TRUE(has(text_chart(chart), "is still under way at the end"));
  EXPECT_FALSE(has(svg_chart(chart), legend));
}

TEST_F(Reports, TheUnexplainedEventIsInTheChartEvenWithoutContext) {
  const Chart chart = chart_of(report_of(bad), bad.unexplained[1]);
  ASSERT_EQ(chart.rows.size(), 1U);
  EXPECT_EQ(chart.lanes.back().title, "the others");
  EXPECT_EQ(chart.rows[0].lines[0].lane, 2U);
  EXPECT_TRUE(has(chart.rows[0].lines[0].text, "1: ACKNACK"));
}

TEST_F(Reports, SeveralCapturesAreNumberedAndNamed) {
  conversation.captures.push_back(conversation.captures[0]);
  conversation.captures[1].name = "1.pcap";
  const std::string text = text_chart(chart_of(report_of(bad), bad.unexplained[0]));
  EXPECT_TRUE(has(text, "      1:4   │◁")) << text;
  EXPECT_TRUE(has(text, "packets 1:N of 0.pcap, 2:N of 1.pcap")) << text;
}

TEST_F(Reports, TheSvgHasTheStoryAndNoMarkupOfOthers) {
  conversation.topology.participants[0].name = "<script>&";
  const std::string svg = to_svg(report_of(bad));
  EXPECT_TRUE(has(svg, "<svg"));
  EXPECT_FALSE(has(svg, "<script>"));
  EXPECT_TRUE(has(svg, "&lt;script&gt;&amp;"));
  EXPECT_TRUE(has(svg, "send lag 30ms"));
  EXPECT_EQ(times(svg, "class=\"band\""), 1U);
  EXPECT_EQ(times(svg, "class=\"cross\""), 2U);
  EXPECT_EQ(to_svg(report_of(good)), "");
}

TEST_F(Reports, TextsOfTheSvgDoNotOverlap) {
  bad.unexplained[0].context = {2, 3, 4, 5, 6};
  for (const Unexplained& one : bad.unexplained) {
    const auto svg = draw::read_svg(svg_chart(chart_of(report_of(bad), one)));
    ASSERT_TRUE(svg);
    EXPECT_EQ(svg->fault(), "");
    EXPECT_TRUE(svg->says("packet"));
  }
}

TEST(Names, NumbersAreRuns) {
  using Numbers = std::vector<std::int64_t>;
  EXPECT_EQ(numbers_text(Numbers{}), "nothing");
  EXPECT_EQ(numbers_text(Numbers{4}), "4");
  EXPECT_EQ(numbers_text(Numbers{1, 2, 3, 5, 7, 8}), "1–3, 5, 7–8");
  EXPECT_EQ(numbers_text(Numbers{1, 3, 5, 7, 9, 11, 13, 15, 17}), "1, 3, 5, 7, 9, 11, 13, 15, …");
}

TEST(Names, NeedsAreWrittenAsOptionsTakeThem) {
  EXPECT_EQ(need_text({"send lag", 96'521'000, 50'000'000}), "send lag 96.521ms (bound 50ms)");
  EXPECT_EQ(need_text({"lateness", 100'000'000, {}}), "lateness 100ms");
  EXPECT_EQ(need_text({"lateness", 0, {}}), "lateness 0ms");
  EXPECT_EQ(need_text({"a HEARTBEAT before it", {}, {}}), "a HEARTBEAT before it");
  EXPECT_EQ(milliseconds(-1'500'000), "-1.500000 ms");
}

}  // namespace chart_test
}  // namespace stormproof::conform
