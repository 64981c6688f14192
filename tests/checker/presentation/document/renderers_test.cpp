// Each renderer on a small document made by hand: what the reader of that format gets to see, and
// that texts of users stay texts.
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "checker/presentation/document/markdown.hpp"
#include "checker/presentation/document/render.hpp"
#include "checker/presentation/text/paragraph.hpp"
#include "tests/checker/presentation/document/html_checks.hpp"

namespace stormproof::report {
namespace renderers_test {

const std::string hostile = "<b>&|`*_\xff\x1b[31m";

Document example() {
  Document document;
  document.title = "stormproof example " + hostile;
  document.tone = Tone::bad;
  document.answer = "two of three fail " + hostile;
  document.elaboration = "of " + code(hostile) + ", " + strong("all") + " of them";
  document.blocks.emplace_back(Paragraph{"a remark", Tone::warn});
  document.blocks.emplace_back(Bullets{{"first " + hostile, "second"}});
  document.blocks.emplace_back(Facts{{{"größe", "1 m"}, {"weight", "2 kg"}}});
  Table table;
  table.caption = "rows";
  table.columns = {{"verdict"}, {"name"}, {"number", Column::Align::right}, {"why"}, {"page only"}};
  table.columns[3].wraps = true;
  table.columns[4].audience = Audience::page;
  table.rows.push_back({{badge(Tone::bad, "violated"), link("ä", "there"), "7",
                         "because of a sentence that is far too long to stand on a single line of "
                         "any terminal " +
                             hostile,
                         "wide " + hostile},
                        true,
                        {Paragraph{"detail of the row"}},
                        "1 detail"});
  table.rows.push_back({{badge(Tone::info, "bounded", "≤"), code("second|row"), "1,234", "short"}});
  document.blocks.emplace_back(Section{"Rows", "rows", {std::move(table)}});
  document.blocks.emplace_back(
      Section{"Folded", "there", {Listing{"a\n```\n</pre>" + hostile}}, true});
  document.blocks.emplace_back(Section{"After it", "", {Paragraph{"last paragraph"}}});
  document.blocks.emplace_back(Paragraph{"only with -v"}, Audience::verbose);
  document.blocks.emplace_back(Paragraph{"only explained"}, Audience::explained);
  document.blocks.emplace_back(Paragraph{"for the terminal"}, Audience::terminal);
  document.blocks.emplace_back(Paragraph{"for documents"}, Audience::documents);
  document.blocks.emplace_back(Paragraph{"for pages"}, Audience::page);
  document.blocks.emplace_back(Paragraph{"in comments"}, Audience::comment);
  document.blocks.emplace_back(
      Later{[]() -> Blocks { return {Paragraph{"made when it is wanted"}}; }});
  document.assumptions = {"nothing is lost " + hostile};
  document.command = "stormproof example 'a b'";
  return document;
}

bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in{text};
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(TextRenderer, SaysTheAnswerFirstAndTheCommandLast) {
  const std::string text = to_text(example());
  EXPECT_TRUE(text.starts_with("✗ two of three fail <b>&|`*_")) << text;
  EXPECT_TRUE(text.ends_with("Repeat it\n  stormproof example 'a b'\n")) << text;
  EXPECT_TRUE(has(text, "\n? a remark\n")) << text;
  EXPECT_TRUE(has(text, "\ngröße   1 m\nweight  2 kg\n")) << text;
  EXPECT_TRUE(has(text, "Assumptions\n  - nothing is lost")) << text;
  EXPECT_TRUE(has(text, "made when it is wanted"));
  EXPECT_LT(text.find("last paragraph"), text.find("Folded")) << "folded sections come last";
}

TEST(TextRenderer, ShowsBlocksToThoseWhoAskForThem) {
  const std::string brief = to_text(example());
  EXPECT_TRUE(has(brief, "for the terminal"));
  for (const char* part :
       {"only with -v", "only explained", "for documents", "for pages", "in comments", "wide"}) {
    EXPECT_FALSE(has(brief, part)) << part;
  }
  const std::string verbose = to_text(example(), {.verbose = true});
  EXPECT_TRUE(has(verbose, "only with -v"));
  EXPECT_TRUE(has(verbose, "only explained"));
  EXPECT_FALSE(has(verbose, "for pages"));
}

TEST(TextRenderer, NamesWhatItLeavesOut) {
  Document document = example();
  document.blocks.emplace_back(Section{"Many numbers", "", {Paragraph{"12 34"}}},
                               Audience::verbose);
  const std::string text = to_text(document, {});
  EXPECT_FALSE(has(text, "12 34"));
  EXPECT_TRUE(has(text, "with -v: Many numbers\n")) << text;
  const std::string verbose = to_text(document, {.verbose = true});
  EXPECT_TRUE(has(verbose, "12 34"));
  EXPECT_FALSE(has(verbose, "with -v:"));
}

TEST(TextRenderer, AColumnIsAsWideAsItsLongestWord) {
  const std::string key = "dds.descriptors.default_publications";
  Document document;
  document.blocks.emplace_back(Table{{{"knob"}, {"what it does"}},
                                     {{{key, "one two three four five six seven"}},
                                      {{"short", "one two three four five six seven"}}}});
  const std::string text = to_text(document, {.columns = 60});
  EXPECT_TRUE(has(text, key + "  one")) << text;
  EXPECT_TRUE(has(text, "short" + std::string(key.size() - 3, ' ') + "one")) << text;
}

TEST(TextRenderer, FitsTheTerminal) {
  for (const std::size_t width : {20U, 60U, 80U, 100U, 500U}) {
    for (const std::string& line : lines_of(to_text(example(), {.columns = width}))) {
      EXPECT_LE(columns(line), std::clamp<std::size_t>(width, 60, 120)) << line;
      EXPECT_FALSE(line.ends_with(' ')) << '"' << line << '"';
    }
  }
}

TEST(TextRenderer, AlignsColumnsWhateverBytesTheyHave) {
  const std::vector<std::string> lines = lines_of(to_text(example()));
  const auto row = [&](std::string_view word) {
    return *std::ranges::find_if(lines, [&](const std::string& line) { return has(line, word); });
  };
  const auto end_of = [&](std::string_view word) {
    const std::string line = row(word);
    return columns(line.substr(0, line.find(word) + word.size()));
  };
  EXPECT_EQ(end_of("number"), end_of("1,234"));
  EXPECT_TRUE(row("violated").starts_with("  * ✗ violated")) << row("violated");
  EXPECT_TRUE(row("bounded").starts_with("    ≤ bounded")) << row("bounded");
  EXPECT_EQ(row("detail of the row"), "      detail of the row");
}

TEST(TextRenderer, ColoursOnlyWhereTheTerminalHasThem) {
  EXPECT_FALSE(has(to_text(example()), "\x1b"));
  const std::string coloured = to_text(example(), {.colours = true});
  EXPECT_TRUE(coloured.starts_with("\x1b[1;31m✗ two of three fail"));
  EXPECT_TRUE(has(coloured, "\x1b[1;31m✗ violated\x1b[0m"));
  EXPECT_FALSE(has(coloured, "\xff"));
  EXPECT_FALSE(has(coloured, "_\x1b[31m")) << "an escape sequence of the user's";
}

TEST(TextRenderer, PutsCellsBelowEachOtherWhereNothingElseFits) {
  Document document;
  Table table;
  for (const char* head : {"one", "two", "three", "four", "five"}) {
    table.columns.push_back({head, Column::Align::left, true});
  }
  const std::string sentence = "a sentence of some length, for every single one of them";
  table.rows.push_back({{sentence, sentence, sentence, sentence, sentence}});
  document.blocks.emplace_back(std::move(table));
  const std::string text = to_text(document, {.columns = 60});
  EXPECT_TRUE(has(text, "one: a sentence")) << text;
  EXPECT_TRUE(has(text, "  five: a sentence")) << text;
}

/// The last columns go first, and are named; what says what a row is about, and what is to stay,
/// stays.
TEST(TextRenderer, LeavesColumnsOutRatherThanBreakLines) {
  Table table{{{"way to discover"}, {"completion", Column::Align::right}}, {}};
  for (const char* head : {"messages", "repairs", "HEARTBEATs", "ACKNACKs", "announcements"}) {
    table.columns.push_back({head, Column::Align::right});
  }
  table.columns.push_back({.head = "breaks at", .stays = true});
  table.rows.push_back(
      {{"server on its own host", "12.34 s", "10,000", "200", "300", "400", "5", "10 robots"}});
  table.wide = true;
  Document document;
  document.blocks.emplace_back(table);
  const std::string narrow = to_text(document, {.columns = 80, .drops_columns = true});
  EXPECT_TRUE(has(narrow, "(not at this width: ")) << narrow;
  EXPECT_TRUE(has(narrow, "announcements; -v shows all)")) << narrow;
  EXPECT_TRUE(has(narrow, "10 robots")) << narrow;
  EXPECT_FALSE(has(narrow, "10,000  200  300  400  5")) << narrow;
  std::istringstream lines{narrow};
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
  for (const Terminal& all :
       {Terminal{.columns = 120, .drops_columns = true},
        Terminal{.columns = 80, .verbose = true, .drops_columns = true}, Terminal{.columns = 80}}) {
    EXPECT_FALSE(has(to_text(document, all), "not at this width"));
    EXPECT_TRUE(has(to_text(document, all), "announcements"));
  }
}

TEST(MarkdownRenderer, KeepsTextsOfUsersTexts) {
  const std::string text = to_markdown(example());
  EXPECT_TRUE(text.starts_with("### stormproof example &lt;b&gt;&amp;\\|\\`\\*\\_")) << text;
  EXPECT_TRUE(has(text, ": ❌ two of three fail &lt;b&gt;")) << text;
  EXPECT_FALSE(has(text, "\xff"));
  EXPECT_TRUE(has(text, "| ❌ violated | ä | 7 |")) << text;
  EXPECT_TRUE(has(text, "| ≤ bounded | `second\\|row` | 1,234 | short |")) << text;
  EXPECT_FALSE(has(text, "page only"));
  EXPECT_TRUE(has(text, "````text\na\n```\n</pre>")) << text;
  EXPECT_TRUE(has(text, "<details><summary>Folded</summary>"));
  EXPECT_TRUE(has(text, "<details><summary>Details</summary>\n\nonly with -v"));
  EXPECT_TRUE(has(text, "Repeat it: `stormproof example 'a b'`"));
  EXPECT_TRUE(has(text, "of ``<b>&\\|`*_"));
  EXPECT_TRUE(has(text, ", **all** of them"));
  EXPECT_FALSE(has(text, "for the terminal"));
  EXPECT_FALSE(has(text, "for pages"));
  EXPECT_FALSE(has(text, "in comments"));
  EXPECT_TRUE(has(to_comment(example(), "example"), "in comments"));
}

TEST(MarkdownRenderer, LeavesOutWhatACommentHasNoRoomFor) {
  Document document = example();
  document.blocks.emplace_back(Section{"Long", "", {Listing{std::string(70'000, 'x')}}, true});
  document.blocks.emplace_back(Section{"Short", "", {Paragraph{"still there"}}});
  const std::string text = to_markdown(document);
  EXPECT_LE(text.size(), markdown_bytes);
  EXPECT_FALSE(has(text, "xxx"));
  EXPECT_TRUE(has(text, "still there"));
  EXPECT_TRUE(has(text, "Left out to fit into a comment: Long. The HTML report")) << text;
}

TEST(MarkdownRenderer, LeavesOutDetailsBeforeTheirTable) {
  Document document;
  Table table;
  table.columns = {{"name"}};
  table.rows.push_back({{"the row"}, false, {Listing{std::string(70'000, 'x')}}});
  document.blocks.emplace_back(Section{"Rows", "", {std::move(table)}, true});
  const std::string text = to_markdown(document);
  EXPECT_TRUE(has(text, "| the row |")) << text;
  EXPECT_FALSE(has(text, "xxx"));
  EXPECT_TRUE(has(text, "Left out to fit into a comment: Rows: details.")) << text;
}

TEST(HtmlRenderer, KeepsTextsOfUsersTexts) {
  const std::string page = to_html(example());
  EXPECT_EQ(html_fault(page), "");
  EXPECT_EQ(outside_requests(page), std::vector<std::string>{});
  EXPECT_TRUE(has(page, "✗ two of three fail &lt;b&gt;&amp;|`*_")) << page;
  EXPECT_FALSE(has(page, "<b>"));
  EXPECT_TRUE(has(page, "<a href=\"#there\">ä</a>"));
  EXPECT_TRUE(has(page, "<details id=\"there\"><summary>Folded</summary>"));
  EXPECT_TRUE(has(page, "<tr class=\"different\">"));
  EXPECT_TRUE(has(page, "<details><summary>1 detail</summary>"));
  EXPECT_TRUE(has(page, "wide &lt;b&gt;"));
  EXPECT_TRUE(has(page, "<details><summary>Details</summary>\n<p>only with -v</p>"));
  EXPECT_TRUE(has(page, "for pages"));
  EXPECT_FALSE(has(page, "for the terminal"));
  EXPECT_FALSE(has(page, "only explained"));
  EXPECT_FALSE(has(page, "in comments"));
}

TEST(HtmlRenderer, DrawingsWithoutCaptionStandSideBySide) {
  Document document;
  const std::string svg = "<svg width=\"1\"></svg>\n";
  document.blocks = {Drawing{svg, ""}, Drawing{svg, ""}, Drawing{svg, "a caption", "third", "M"}};
  const std::string page = to_html(document);
  EXPECT_EQ(html_fault(page), "");
  EXPECT_TRUE(
      has(page, "<div class=\"plots\">\n<svg class=\"art art-0\" width=\"1\"></svg>\n<svg"));
  EXPECT_TRUE(has(page, "</div>\n<div data-machine=\"M\"><figure><figcaption>a caption"));
}

Finding finding(const std::string& id, Finding::Outcome outcome, Finding::Shown shown = {}) {
  Finding one;
  one.id = id;
  one.statement = "rule " + id;
  one.outcome = outcome;
  one.word = "word";
  one.message = "message of " + id;
  one.shown = shown;
  return one;
}

Document with_findings() {
  using Outcome = Finding::Outcome;
  Document document;
  document.title = "stormproof example";
  document.findings = {finding("good", Outcome::passed),
                       finding("bad", Outcome::failed),
                       finding("open", Outcome::unknown),
                       finding("remark", Outcome::note),
                       finding("only-tests", Outcome::failed, Finding::Shown::tests),
                       finding("only-code", Outcome::failed, Finding::Shown::code),
                       finding("bad", Outcome::failed)};
  document.findings[5].warning = true;
  document.exit_code = 1;
  return document;
}

TEST(JUnitRenderer, CountsWhatIsATest) {
  const std::string xml = to_junit(with_findings());
  EXPECT_TRUE(has(xml, "tests=\"5\" failures=\"3\" errors=\"1\" time=\"0.000\"")) << xml;
  EXPECT_TRUE(has(xml, "classname=\"stormproof.example\" name=\"only-tests\""));
  EXPECT_FALSE(has(xml, "only-code"));
  EXPECT_TRUE(has(xml, "<system-out>rule remark: message of remark\n</system-out>"));
  EXPECT_TRUE(has(xml, "<failure type=\"word\" message=\"message of bad\">"));
}

TEST(SarifRenderer, NamesEachRuleOnce) {
  const nlohmann::ordered_json run = to_sarif(with_findings())["runs"][0];
  EXPECT_EQ(run["tool"]["driver"]["rules"].size(), 5U);
  ASSERT_EQ(run["results"].size(), 6U);
  EXPECT_EQ(run["results"][0]["kind"], "pass");
  EXPECT_EQ(run["results"][1]["level"], "error");
  EXPECT_EQ(run["results"][2]["level"], "warning");
  EXPECT_EQ(run["results"][3]["level"], "note");
  EXPECT_EQ(run["results"][4]["level"], "warning");
  EXPECT_EQ(run["results"][5]["ruleIndex"], run["results"][1]["ruleIndex"]);
  EXPECT_EQ(run["results"][1]["message"]["text"], "word: message of bad");
  EXPECT_EQ(run["invocations"][0]["exitCode"], 1);
}

}  // namespace renderers_test
}  // namespace stormproof::report
