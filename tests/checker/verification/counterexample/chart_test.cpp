// Sequence charts: what is in the model, and what its two renderings make of it.
#include "checker/verification/counterexample/chart.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "checker/presentation/sequence/chart_layout.hpp"
#include "tests/checker/presentation/diagrams/svg_texts.hpp"
#include "tests/checker/verification/counterexample/examples.hpp"

namespace stormproof::counterexample {
namespace chart_test {

const Chart::Packet* packet_named(const Chart& chart, const std::string& name) {
  const auto found = std::ranges::find(chart.packets, name, &Chart::Packet::name);
  return found == chart.packets.end() ? nullptr : &*found;
}

TEST(Chart, OfTheSmallestDeployment) {
  const Chart chart = chart_of(smallest());
  ASSERT_EQ(chart.lanes.size(), 3U);
  EXPECT_EQ(chart.lanes[0].title, "participant 0");
  EXPECT_EQ(chart.lanes[1].title, "air");
  EXPECT_TRUE(chart.lanes[1].network);
  EXPECT_EQ(chart.lanes[2].subtitle, "host 1, 1 pub + 1 sub");
  const Chart::Row& last = chart.rows.back();
  EXPECT_TRUE(last.violation);
  EXPECT_EQ(last.event, 101U);
  EXPECT_EQ(std::ranges::count_if(chart.rows, &Chart::Row::violation), 1);
  const Chart::Packet* heartbeat = packet_named(chart, "p5");
  ASSERT_NE(heartbeat, nullptr);
  EXPECT_EQ(heartbeat->label, "p5 HEARTBEAT 0→1 pub");
  ASSERT_EQ(heartbeat->blocks.size(), 2U);
  EXPECT_EQ(heartbeat->blocks[0].stage, "uplink");
  EXPECT_TRUE(heartbeat->blocks[1].finished);
  EXPECT_LT(heartbeat->blocks[0].last_row, heartbeat->blocks[1].first_row + 1);
  // The repair has just been generated and waits in the source queue.
  ASSERT_NE(packet_named(chart, "p18"), nullptr);
  EXPECT_TRUE(packet_named(chart, "p18")->blocks.empty());
}

TEST(Chart, ALostPacketHasNoReception) {
  const Chart chart = chart_of(lossy());
  EXPECT_EQ(chart.lanes[1].title, "network");
  EXPECT_EQ(chart.lanes[1].subtitle, "constant delay 30 µs");
  const Chart::Packet* lost = packet_named(chart, "p4");
  ASSERT_NE(lost, nullptr);
  EXPECT_TRUE(lost->lost);
  const auto position = static_cast<std::size_t>(lost - chart.packets.data());
  int losses = 0;
  for (const Chart::Row& row : chart.rows) {
    for (const Chart::Line& line : row.lines) {
      if (std::ranges::count(line.packets, position) == 0) continue;
      EXPECT_NE(line.kind, Chart::Line::Kind::received);
      losses += line.kind == Chart::Line::Kind::lost ? 1 : 0;
    }
  }
  EXPECT_EQ(losses, 1);
}

TEST(Chart, PacketsOfOneHostDoNotTouchTheNetwork) {
  const Chart chart = chart_of(fastdds());
  const Chart::Packet* local = packet_named(chart, "local");
  ASSERT_NE(local, nullptr);
  EXPECT_TRUE(local->local);
  EXPECT_TRUE(local->blocks.empty());
}

class Charts : public testing::TestWithParam<std::size_t> {
 protected:
  const props::Counterexample& example_ = examples()[GetParam()].counterexample;
  const Chart chart_ = chart_of(example_);
};

TEST_P(Charts, TimeRunsDown) {
  for (std::size_t r = 1; r < chart_.rows.size(); ++r) {
    EXPECT_LE(chart_.rows[r - 1].time, chart_.rows[r].time);
    EXPECT_LT(chart_.rows[r - 1].event, chart_.rows[r].event);
  }
  EXPECT_EQ(chart_.rows.back().event, example_.event);
}

TEST_P(Charts, TheSvgIsWellFormedAndItsTextsDoNotOverlap) {
  const auto svg = draw::read_svg(svg_chart(chart_));
  ASSERT_TRUE(svg);
  EXPECT_EQ(svg->fault(), "");
  EXPECT_EQ(svg->count("✗ " + example_.property + " is violated"), 1U);
  EXPECT_EQ(svg->count("✗ Why the property breaks"), 1U);
  EXPECT_EQ(svg->count("✗" + std::to_string(example_.event)), 1U);
  for (const Chart::Lane& lane : chart_.lanes) EXPECT_TRUE(svg->says(lane.title)) << lane.title;
}

TEST_P(Charts, TheSvgShowsEveryService) {
  const auto svg = draw::read_svg(svg_chart(chart_));
  ASSERT_TRUE(svg);
  for (const Chart::Packet& packet : chart_.packets) {
    for (const Chart::Block& block : packet.blocks) {
      EXPECT_EQ(svg->count(block_text(packet, block)), 1U) << block_text(packet, block);
    }
  }
}

TEST_P(Charts, MermaidHasAllLanesAndTheViolation) {
  const std::string text = mermaid_chart(chart_);
  EXPECT_EQ(text.rfind("sequenceDiagram\n", 0), 0U);
  for (std::size_t k = 0; k < chart_.lanes.size(); ++k) {
    EXPECT_NE(text.find("  participant L" + std::to_string(k) + " as " + chart_.lanes[k].title),
              std::string::npos);
  }
  EXPECT_NE(text.find("✗ " + example_.property + " is violated at event " +
                      std::to_string(example_.event)),
            std::string::npos);
  EXPECT_NE(text.find("  rect rgba("), std::string::npos);
  EXPECT_EQ(text.substr(text.size() - 6), "  end\n");
}

INSTANTIATE_TEST_SUITE_P(Examples, Charts, testing::Range(std::size_t{0}, example_names.size()),
                         [](const auto& chosen) {
                           return std::string{example_names[chosen.param]};
                         });

TEST(MermaidChart, SaysWhoSendsWhatWhen) {
  const std::string text = mermaid_chart(smallest());
  EXPECT_NE(text.find("  L0->>L1: sends p5 HEARTBEAT 0→1 pub [WriterSideOpens.4]\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("  L1->>L2: 6.573343 ms: receives p5 HEARTBEAT 0→1 pub\n"),
            std::string::npos);
  EXPECT_NE(text.find("  L2->>L1: sends p14 ACKNACK 1→0 pub, lacks 0–9 [AckNackDue.2]\n"),
            std::string::npos);
  EXPECT_NE(
      text.find("  Note over L0: 0→1 pub 0–9: U→R<br/>repair DATA generation at 13.653072 ms"),
      std::string::npos);
}

TEST(MermaidChart, MarksLostAndLocalPackets) {
  EXPECT_NE(mermaid_chart(lossy()).find("  L1-xL1: "), std::string::npos);
  EXPECT_NE(mermaid_chart(fastdds()).find("-->>"), std::string::npos);
}

TEST(SvgChart, MarksLostPacketsWithACross) {
  EXPECT_NE(svg_chart(lossy()).find("class=\"cross\""), std::string::npos);
  EXPECT_EQ(svg_chart(smallest()).find("class=\"cross\""), std::string::npos);
}

}  // namespace chart_test
}  // namespace stormproof::counterexample
