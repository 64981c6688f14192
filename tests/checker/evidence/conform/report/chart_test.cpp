// The chart of an unexplained event and the names in it.
#include "checker/evidence/conform/report/chart.hpp"

#include <gtest/gtest.h>

#include "checker/evidence/conform/report/names.hpp"
#include "tests/checker/evidence/conform/report/results.hpp"

namespace stormproof::conform {

namespace chart_test {

using namespace testing;

TEST_F(Reports, TheChartMarksTheUnexplainedEvent) {
  const Chart chart = chart_of(report_of(bad), bad.unexplained[0]);
  ASSERT_EQ(chart.arrows.size(), 3U);
  EXPECT_TRUE(chart.arrows[0].to_right);
  EXPECT_FALSE(chart.arrows[1].to_right);
  EXPECT_TRUE(chart.arrows[1].is_unexplained);
  EXPECT_EQ(chart.arrows[0].fate, Chart::Arrow::Fate::received);
  EXPECT_EQ(chart.arrows[0].received_ns, 2'000'000);
  EXPECT_EQ(chart.arrows[1].fate, Chart::Arrow::Fate::dropped);
  EXPECT_EQ(chart.arrows[2].fate, Chart::Arrow::Fate::lost);
  EXPECT_EQ(chart.arrows[1].label, "ACKNACK 1 for publications: has nothing, asks for 1–2");
  const std::string text = text_chart(chart);
  EXPECT_EQ(times(text, "✗"), 1U);
  EXPECT_TRUE(has(text, "✗     2.500000 ms        4   │◁"));
  EXPECT_TRUE(has(text, "arrives 2.000000 ms"));
  EXPECT_TRUE(has(text, "is lost"));
}

TEST_F(Reports, SubmessagesOfOneDatagramAreOneArrow) {
  bad.unexplained[0].context = {2, 3, 4, 5, 6};
  const Chart chart = chart_of(report_of(bad), bad.unexplained[0]);
  ASSERT_EQ(chart.arrows.size(), 4U);
  EXPECT_EQ(chart.arrows[2].label, "DATA 1–2 of publications");
  EXPECT_EQ(chart.arrows[2].events, (std::vector<std::size_t>{4, 5}));
  EXPECT_EQ(chart.arrows[2].fate, Chart::Arrow::Fate::lost);
  EXPECT_EQ(chart.arrows[3].label, "ACKNACK 2 for publications: has 1–2");
}

TEST_F(Reports, TheUnexplainedEventIsInTheChartEvenWithoutContext) {
  const Chart chart = chart_of(report_of(bad), bad.unexplained[1]);
  ASSERT_EQ(chart.arrows.size(), 1U);
  EXPECT_EQ(chart.right.title, "the others");
  EXPECT_FALSE(chart.arrows[0].to_right);
  EXPECT_TRUE(has(chart.arrows[0].label, "1: ACKNACK"));
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
