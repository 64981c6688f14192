// What charts leave out: a common start, and packets beside each other without end.
#include <gtest/gtest.h>

#include "checker/presentation/sequence/chart.hpp"
#include "checker/presentation/sequence/chart_layout.hpp"
#include "tests/checker/presentation/diagrams/svg_texts.hpp"

namespace stormproof::sequence {
namespace fold_test {

using Kind = Chart::Line::Kind;

/// Two participants and a channel; in row K something happens at the left one.
Chart chart_with(std::size_t rows) {
  Chart chart;
  chart.title = "an example";
  chart.lanes = {{"participant 0", "", false}, {"air", "", true}, {"participant 1", "", false}};
  for (std::size_t k = 0; k < rows; ++k) {
    Chart::Row row;
    row.event = 10 * k;
    row.time = model::Nanoseconds{static_cast<std::int64_t>(k) * 1000};
    row.lines.push_back({Kind::change, 0, "step " + std::to_string(k), {}});
    chart.rows.push_back(row);
  }
  return chart;
}

Chart::Packet packet_with(std::vector<Chart::Block> blocks, std::size_t number) {
  Chart::Packet packet;
  packet.name = "p" + std::to_string(number);
  packet.label = packet.name + " DATA";
  packet.blocks = std::move(blocks);
  return packet;
}

TEST(CommonRows, EndWhereTheChartsDiffer) {
  const Chart chart = chart_with(6);
  EXPECT_EQ(common_rows(chart, chart), 6U);
  EXPECT_EQ(common_rows(chart, chart_with(4)), 4U);
  Chart other = chart;
  other.rows[3].lines[0].text = "something else";
  EXPECT_EQ(common_rows(chart, other), 3U);
  other = chart;
  other.lanes[2].title = "participant 7";
  EXPECT_EQ(common_rows(chart, other), 0U) << "lanes with other meanings";
}

TEST(FoldStart, LeavesOneLineAndMovesTheRest) {
  Chart chart = chart_with(6);
  chart.packets.push_back(packet_with({{1, "uplink", 0, 1, true}, {1, "downlink", 1, 4, true}}, 1));
  fold_start(chart, 3, "the same in both");
  ASSERT_EQ(chart.rows.size(), 4U);
  EXPECT_EQ(chart.rows[0].kind, Chart::Row::Kind::gap);
  EXPECT_EQ(chart.rows[1].event, 30U);
  ASSERT_EQ(chart.packets[0].blocks.size(), 1U) << "the uplink is over before the rest begins";
  EXPECT_EQ(chart.packets[0].blocks[0].first_row, 0U);
  EXPECT_EQ(chart.packets[0].blocks[0].last_row, 2U);
  const auto svg = draw::read_svg(svg_chart(chart));
  ASSERT_TRUE(svg);
  EXPECT_EQ(svg->fault(), "");
  EXPECT_TRUE(svg->says("⋮ the same in both"));
  EXPECT_FALSE(svg->says("step 2"));
  EXPECT_TRUE(svg->says("step 3"));
}

TEST(SvgChart, IsNotWiderForEveryPacketOnTheAir) {
  const auto with_packets = [](std::size_t count) {
    Chart chart = chart_with(3);
    for (std::size_t k = 0; k < count; ++k) {
      chart.packets.push_back(packet_with({{1, "uplink", 0, 2, true}}, 100 + k));
    }
    return chart;
  };
  const auto few = draw::read_svg(svg_chart(with_packets(4)));
  const auto many = draw::read_svg(svg_chart(with_packets(40)));
  ASSERT_TRUE(few && many);
  EXPECT_EQ(few->width, many->width);
  EXPECT_TRUE(few->says("p103 uplink"));
  EXPECT_TRUE(many->says("p103 uplink"));
  EXPECT_FALSE(many->says("p104 uplink"));
  EXPECT_TRUE(many->says("36 more are not drawn")) << "and says so";
  EXPECT_FALSE(few->says("not drawn"));
  EXPECT_EQ(many->fault(), "");
}

}  // namespace fold_test
}  // namespace stormproof::sequence
