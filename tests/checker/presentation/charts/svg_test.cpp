// Charts are well-formed, hold what they are given, and never print a number that is none.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include "checker/presentation/charts/plot.hpp"
#include "tests/checker/presentation/diagrams/svg_texts.hpp"

namespace stormproof::plot {
namespace svg_test {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

/// All texts of the document that have this class among theirs.
std::vector<std::string> texts_of_class(const std::string& svg, const std::string& wanted) {
  tinyxml2::XMLDocument document;
  EXPECT_EQ(document.Parse(svg.c_str()), tinyxml2::XML_SUCCESS);
  std::vector<std::string> texts;
  if (document.RootElement() == nullptr) return texts;
  for (const auto* text = document.RootElement()->FirstChildElement("text"); text != nullptr;
       text = text->NextSiblingElement("text")) {
    const std::string classes = text->Attribute("class");
    if (classes.find(wanted) != std::string::npos && text->GetText() != nullptr) {
      texts.emplace_back(text->GetText());
    }
  }
  return texts;
}

/// Well-formed, self-contained, without words for missing numbers, and no two texts overlap.
void expect_sound(const std::string& svg) {
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(svg.c_str()), tinyxml2::XML_SUCCESS) << document.ErrorStr();
  EXPECT_STREQ(document.RootElement()->Name(), "svg");
  EXPECT_EQ(count(svg, "nan"), 0U);
  EXPECT_EQ(count(svg, "inf"), 0U);
  EXPECT_EQ(count(svg, "http"), 1U) << "only the name space";
  EXPECT_EQ(count(svg, "<script"), 0U);
  EXPECT_NE(svg.find("prefers-color-scheme: dark"), std::string::npos);
  const auto texts = draw::read_svg(svg);
  ASSERT_TRUE(texts.has_value());
  EXPECT_EQ(texts->fault(), "");
}

Chart example() {
  Chart chart{"Completion", "For tests", {"N_E"}, {"completion"}, {}};
  chart.y.unit = "s";
  chart.series.push_back({"model", {1, 2, 3}, {0.5, 1.0, 4.0}});
  return chart;
}

TEST(ChartSvg, HasOneMarkForEachPointAndOneLine) {
  Chart chart = example();
  chart.series[0].mark = Mark::points;
  const std::string points = to_svg(chart);
  expect_sound(points);
  EXPECT_EQ(count(points, "class=\"curve"), 0U);
  // A circle is two arcs; four circles: three points and one in the legend.
  EXPECT_EQ(count(points, " 0 1 0 "), 8U);
  chart.series[0].mark = Mark::line;
  EXPECT_EQ(count(to_svg(chart), "class=\"curve s0\""), 2U) << "in the chart and in the legend";
}

TEST(ChartSvg, LeavesGapsWhereThereIsNoNumber) {
  Chart chart = example();
  chart.series[0] = {"", {1, 2, 3, 4, 5}, {1, nan, infinity, 2, 3}};
  chart.series[0].mark = Mark::line;
  const std::string svg = to_svg(chart);
  expect_sound(svg);
  const std::size_t curve = svg.find("class=\"curve");
  const std::size_t start = svg.rfind("<path", curve);
  EXPECT_EQ(count(svg.substr(start, curve - start), "L"), 1U) << "only from 4 to 5";
}

TEST(ChartSvg, DrawsNothingBelowZeroOnALogAxis) {
  Chart chart = example();
  chart.y.scale = Scale::log;
  chart.series[0].y = {0, -1, 10};
  chart.series[0].mark = Mark::points;
  const std::string svg = to_svg(chart);
  expect_sound(svg);
  EXPECT_EQ(count(svg, " 0 1 0 "), 4U) << "one point and the legend";
}

TEST(ChartSvg, CutsOffWhatIsOutsideOfAGivenRange) {
  Chart chart = example();
  chart.y.max = 2;
  chart.series[0].mark = Mark::points;
  EXPECT_EQ(count(to_svg(chart), " 0 1 0 "), 6U) << "two of three points and the legend";
}

TEST(ChartSvg, DrawsBarsAndBandsOfASpread) {
  Chart chart = example();
  chart.series[0].low = {0.4, nan, 3.0};
  chart.series[0].high = {0.6, 2.0, 6.0};
  const std::string bars = to_svg(chart);
  EXPECT_EQ(count(bars, "class=\"whisker"), 1U);
  chart.series[0].spread = Spread::band;
  chart.series[0].low[1] = 0.9;
  const std::string band = to_svg(chart);
  expect_sound(band);
  EXPECT_EQ(count(band, "class=\"band"), 1U);
  EXPECT_EQ(count(band, "class=\"whisker"), 0U);
}

TEST(ChartSvg, DrawsReferencesAndAnnotations) {
  Chart chart = example();
  chart.references = {{Reference::Kind::diagonal, 0, "model = observed"},
                      {Reference::Kind::horizontal, 2, "limit"},
                      {Reference::Kind::vertical, 2.5, ""}};
  chart.annotations = {{1, 0.5, "here"}, {99, 99, "outside"}};
  const std::string svg = to_svg(chart);
  expect_sound(svg);
  EXPECT_EQ(count(svg, "class=\"reference\""), 4U) << "the diagonal is in the legend, too";
  EXPECT_EQ(texts_of_class(svg, "halo"), (std::vector<std::string>{"limit", "here"}));
  EXPECT_EQ(count(svg, ">model = observed</text>"), 1U);
}

TEST(ChartSvg, EscapesEveryText) {
  Chart chart = example();
  chart.title = "a < b & \"c\"";
  chart.y.label = "<&>";
  chart.series[0].name = "</svg>";
  chart.annotations = {{1, 0.5, "x > y"}};
  const std::string svg = to_svg(chart);
  expect_sound(svg);
  EXPECT_EQ(texts_of_class(svg, "chart-title"), std::vector<std::string>{"a < b & \"c\""});
}

TEST(ChartSvg, IsDrawnWithoutData) {
  expect_sound(to_svg(Chart{}));
  Chart chart = example();
  chart.series[0] = {"nothing", {nan}, {nan}};
  expect_sound(to_svg(chart));
  chart.series[0] = {"uneven", {1, 2, 3}, {1}, {0.5}, {2, 3, 4}};
  expect_sound(to_svg(chart));
}

TEST(BarSvg, HasABarForEachValue) {
  const BarChart chart{"Counts",
                       "",
                       {"messages"},
                       {"SPDP", "HEARTBEAT"},
                       {{"model", {120, 18'106}}, {"published", {529.8, nan}}}};
  const std::string svg = to_svg(chart);
  expect_sound(svg);
  EXPECT_EQ(count(svg, "<path"), 3U + 2U) << "three bars and the heads of two markers";
  EXPECT_EQ(texts_of_class(svg, "small"), (std::vector<std::string>{"120", "18.1k", "530"}));
}

TEST(BarSvg, GivesZeroNoLengthOnALogAxis) {
  BarChart chart{"", "", {"messages", Scale::log}, {"repair"}, {{"model", {0}}, {"live", {1e6}}}};
  const std::string svg = to_svg(chart);
  expect_sound(svg);
  EXPECT_EQ(texts_of_class(svg, "small"), (std::vector<std::string>{"0", "1M"}));
  EXPECT_NE(svg.find("h0.0v"), std::string::npos);
}

TEST(TornadoSvg, DrawsBothEndsFromTheBase) {
  Tornado chart{"Effects", "", {"completion"}, 5, {}};
  chart.bars = {{"both sides", 2, 9, "1 ms", "4 ms"},
                {"one side", 7, 6, "a", "b"},
                {"unknown", nan, nan, "c", "d"}};
  const std::string svg = to_svg(chart);
  expect_sound(svg);
  EXPECT_EQ(count(svg, "class=\"f0\""), 2U + 1U) << "two bars and the legend";
  EXPECT_EQ(texts_of_class(svg, "small"), (std::vector<std::string>{"4 ms", "1 ms", "a"}));
}

TEST(HeatMapSvg, HasACellForEachValue) {
  HeatMap chart{"Ratio", "", "N_E", "N_P", {"2", "4"}, {"1", "2"}, {{1, 2}, {nan, 8}}, "ratio"};
  const std::string svg = to_svg(chart);
  expect_sound(svg);
  EXPECT_EQ(count(svg, "rx=\"0\" class=\"h"), 3U + 10U) << "three cells and the colour scale";
  EXPECT_EQ(texts_of_class(svg, "small"), (std::vector<std::string>{"1", "2", "8"}));
  chart.scale = Scale::log;
  chart.value = {{0, -1}};
  expect_sound(to_svg(chart));
}

/// Where a text stands.
draw::PlacedText placed(const Chart& chart, const std::string& text) {
  const auto svg = draw::read_svg(to_svg(chart));
  EXPECT_TRUE(svg);
  for (const draw::PlacedText& one : svg->texts) {
    if (one.text == text) return one;
  }
  ADD_FAILURE() << text;
  return {};
}

TEST(Charts, CurvesDoNotStrikeThroughLabels) {
  Chart chart = example();
  chart.references.push_back({Reference::Kind::vertical, 2, "all sent"});
  chart.series = {{"low", {1, 2, 3}, {0, 0, 4}, {}, {}, Mark::line}};
  const draw::PlacedText free = placed(chart, "all sent");
  // A curve right where the label was: along the top, from the line to the right.
  chart.series.push_back({"high", {2, 2.5, 3}, {3.9, 3.9, 3.9}, {}, {}, Mark::line});
  const draw::PlacedText moved = placed(chart, "all sent");
  EXPECT_TRUE(moved.top > free.bottom || moved.right < free.left)
      << moved.left << " " << moved.top << " was " << free.left << " " << free.top;
}

TEST(Bars, AreMarksOnALogAxisThatHasNoZero) {
  BarChart chart{
      "Messages", "For tests", {"messages"}, {"DATA", "HEARTBEAT"}, {{"model", {3, 300}}}};
  EXPECT_EQ(count(to_svg(chart), "rx=\"0\" class=\"f0\""), 1U) << "the legend's";
  chart.value.scale = Scale::log;
  const std::string svg = to_svg(chart);
  expect_sound(svg);
  EXPECT_EQ(count(svg, "rx=\"0\" class=\"f0\""), 0U);
  EXPECT_EQ(count(svg, "a4 4 0 1 0 8 0"), 3U) << "two values and the legend";
}

}  // namespace svg_test
}  // namespace stormproof::plot
