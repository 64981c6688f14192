// Charts name the effect of the composition behind an arrow or timer if they know it, in every
// rendering, and say nothing if they do not.
#include <gtest/gtest.h>

#include "checker/presentation/sequence/chart.hpp"
#include "tests/checker/presentation/diagrams/svg_texts.hpp"

namespace stormproof::sequence {
namespace effect_test {

using Line = Chart::Line;

/// Participant 1 sends an ACKNACK that participant 0 receives, and starts a timer for.
Chart acknack(const std::string& sent_by, const std::string& started_by) {
  Chart chart;
  chart.title = "a property is violated";
  chart.lanes = {{"participant 0", "", false}, {"network", "", true}, {"participant 1", "", false}};
  chart.packets.push_back({"p1", "p1 ACKNACK", {}, false, false, 2, {}});
  Chart::Row sent;
  sent.lines = {{Line::Kind::sent, 2, "sends p1 ACKNACK", {0}, sent_by}};
  Chart::Row received;
  received.event = 1;
  received.lines = {{Line::Kind::received, 0, "receives p1 ACKNACK", {0}, ""},
                    {Line::Kind::change, 0, "repair at 1 ms", {}, started_by}};
  chart.rows = {sent, received};
  return chart;
}

TEST(ChartEffects, AreNamedInEveryRendering) {
  const Chart chart = acknack("AckNackDue.2", "AckNackArrives.4");
  for (const std::string& drawn : {text_chart(chart), mermaid_chart(chart)}) {
    EXPECT_NE(drawn.find("sends p1 ACKNACK [AckNackDue.2]"), std::string::npos) << drawn;
    EXPECT_NE(drawn.find("repair at 1 ms [AckNackArrives.4]"), std::string::npos) << drawn;
  }
  const auto svg = draw::read_svg(svg_chart(chart));
  ASSERT_TRUE(svg);
  EXPECT_TRUE(svg->says("sends p1 ACKNACK [AckNackDue.2]"));
  EXPECT_TRUE(svg->says("repair at 1 ms [AckNackArrives.4]"));
  EXPECT_EQ(svg->fault(), "");
}

TEST(ChartEffects, ThatAreNotKnownLeaveNoTrace) {
  const Chart chart = acknack("", "");
  for (const std::string& drawn : {text_chart(chart), mermaid_chart(chart)}) {
    EXPECT_EQ(drawn.find('['), std::string::npos) << drawn;
  }
  EXPECT_FALSE(draw::read_svg(svg_chart(chart))->says("["));
}

}  // namespace effect_test
}  // namespace stormproof::sequence
