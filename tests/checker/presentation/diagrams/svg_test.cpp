// The SVG canvas: escaping, widths, and the reader that the other tests rely on.
#include "checker/presentation/diagrams/svg.hpp"

#include <gtest/gtest.h>

#include "checker/presentation/text/paragraph.hpp"
#include "tests/checker/presentation/diagrams/svg_texts.hpp"

namespace stormproof::draw {
namespace svg_test {

std::string document(int second_x) {
  Svg svg{"a < b", "c & d"};
  svg.text(10, 20, "\"x\" <y> & z", "");
  svg.text(second_x, 20, "next", "quiet");
  return svg.finish(400, 100);
}

TEST(Svg, EscapesWhatXmlGivesAMeaning) {
  EXPECT_EQ(xml_text("a<b>&\"c\"\x01"), "a&lt;b&gt;&amp;&quot;c&quot;");
  const auto svg = read_svg(document(200));
  ASSERT_TRUE(svg);
  EXPECT_EQ(svg->texts[0].text, "\"x\" <y> & z");
  EXPECT_EQ(svg->width, 400);
}

TEST(Svg, FollowsTheViewersColours) {
  EXPECT_NE(document(200).find("prefers-color-scheme: dark"), std::string::npos);
}

TEST(Svg, WidthsAreBoundsAndCountCharactersNotBytes) {
  EXPECT_EQ(text_width("", 12), 0);
  EXPECT_GE(text_width("0123456789", 12), 73);  // 0.602 em a column
  EXPECT_LE(text_width("0123456789", 12), 80);
  EXPECT_LT(text_width("→→→→", 12), text_width("0123456", 12));
  EXPECT_GE(text_width("→→→→", 12), text_width("0123", 12));
}

TEST(Svg, TheReaderFindsFaults) {
  EXPECT_EQ(read_svg(document(200))->fault(), "");
  EXPECT_EQ(read_svg(document(60))->fault(), "'\"x\" <y> & z' and 'next' overlap");
  EXPECT_EQ(read_svg(document(390))->fault(), "'next' leaves the drawing");
  EXPECT_FALSE(read_svg("<svg><text></svg>"));
  EXPECT_FALSE(read_svg("<html></html>"));
}

TEST(WrappedText, BreaksAtSpacesAndIndents) {
  using Lines = std::vector<std::string>;
  EXPECT_EQ(report::wrapped("one two three", 7, 0), (Lines{"one two", "three"}));
  EXPECT_EQ(report::wrapped("one two three", 7, 2), (Lines{"one two", "  three"}));
  EXPECT_EQ(report::wrapped("a verylongword b", 5, 2), (Lines{"a", "  verylongword", "  b"}));
  EXPECT_EQ(report::wrapped("", 7, 2), (Lines{""}));
  EXPECT_EQ(report::wrapped("τ_H τ_A", 7, 0), (Lines{"τ_H τ_A"}));
}

}  // namespace svg_test
}  // namespace stormproof::draw
