// HTML reports: nothing of a user becomes HTML, nothing is loaded, both colour schemes are
// readable, and everything that a reader looks for is there.
#include <algorithm>

#include <gtest/gtest.h>

#include "checker/presentation/document/drawings.hpp"
#include "checker/presentation/document/html_page.hpp"
#include "checker/presentation/document/render.hpp"
#include "checker/verification/counterexample/machine_states.hpp"
#include "tests/checker/presentation/document/examples.hpp"
#include "tests/checker/presentation/document/html_checks.hpp"
#include "tests/checker/verification/counterexample/examples.hpp"

namespace stormproof::report {
namespace pages_test {

const std::string& check_page() {
  static const std::string page = [] {
    CheckExample example;
    return to_html(document_of(example.report(), example.context()));
  }();
  return page;
}

const std::string& diff_page() {
  static const std::string page = [] {
    Document document = document_of(regression(), {{"telling-apart.base", "diff/base.jsonl"}});
    document.command = "stormproof diff old.xml new.xml";
    return to_html(document);
  }();
  return page;
}

void expect_harmless(const std::string& page) {
  EXPECT_EQ(html_fault(page), "");
  EXPECT_EQ(outside_requests(page), std::vector<std::string>{});
  EXPECT_EQ(occurrences(page, "<script"), 1U);
  EXPECT_EQ(page.find("pwned=1</script>"), std::string::npos);
  EXPECT_NE(page.find("&lt;script&gt;pwned=1&lt;/script&gt;"), std::string::npos);
  EXPECT_EQ(page.find('\xff'), std::string::npos);
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(page.find(" onclick="), std::string::npos);
}

TEST(Pages, NothingOfAUserBecomesHtml) {
  expect_harmless(check_page());
  expect_harmless(diff_page());
}

TEST(Pages, TheChecksNoticeWhatIsWrong) {
  EXPECT_NE(html_fault("<p><b>x</p></b>"), "");
  EXPECT_NE(html_fault(" <p>x"), "");
  EXPECT_NE(html_fault(" <p id=\"a\"></p><p id=\"a\"></p>"), "");
  EXPECT_NE(html_fault(" <p class=x></p>"), "");
  for (const char* request :
       {"<img src=\"x\">", "<a href=\"https://a.b\">", "a { background: url(x.png) }",
        "<link rel=\"stylesheet\">", "@import 'x';", "<script src=\"a.js\">", "fetch(1)"}) {
    EXPECT_EQ(outside_requests(request).empty(), false) << request;
  }
  EXPECT_TRUE(outside_requests("<a href=\"#x\"> url(#arrow)").empty());
}

TEST(Pages, ACheckShowsVerdictsFirstThenEachViolationWithChartAndSteps) {
  const std::string& page = check_page();
  const std::size_t verdicts = page.find("id=\"holds\"");
  const std::size_t violations = page.find("id=\"violations\"");
  EXPECT_LT(page.find("✗ FAIL; 2 of 4 properties are violated"), verdicts);
  EXPECT_LT(verdicts, violations);
  EXPECT_LT(violations, page.find("id=\"run\""));
  EXPECT_LT(page.find("id=\"run\""), page.find("id=\"profile\""));
  EXPECT_EQ(occurrences(page, "class=\"stepper\""), 2U);
  EXPECT_NE(page.find("data-drawing=\"chart-1\""), std::string::npos);
  EXPECT_NE(page.find("<svg id=\"chart-1\""), std::string::npos);
  EXPECT_NE(page.find("class=\"row r0\""), std::string::npos);
  EXPECT_NE(page.find("stormproof replay ce/storm.free-threshold.jsonl"), std::string::npos);
  EXPECT_NE(page.find("(not in the model)"), std::string::npos);
  EXPECT_NE(page.find("my robots.yaml:7"), std::string::npos);
}

TEST(Pages, StepsTellTheStatesAfterThem) {
  const std::string& page = check_page();
  EXPECT_NE(page.find("data-of=\"DescriptorRepair\" data-states=\"U\""), std::string::npos);
  EXPECT_NE(page.find("data-of=\"DescriptorRepair\" data-states=\"R\""), std::string::npos);
  EXPECT_NE(page.find("data-machine=\"DescriptorRepair\""), std::string::npos);
}

const counterexample::StateRow& row_named(const std::vector<counterexample::StateRow>& rows,
                                          const std::string& machine) {
  return *std::ranges::find(rows, machine, &counterexample::StateRow::machine);
}

TEST(MachineStates, FollowTheRunOfACounterexample) {
  const props::Counterexample run = counterexample::delayed();
  const std::vector<std::uint64_t> events{0, run.event - 1, run.event};
  const auto states = counterexample::states_after(run, events);
  ASSERT_EQ(states.size(), 3U);
  EXPECT_EQ(row_named(states[0], "DiscoveryReader").text, "Unknown");
  EXPECT_EQ(row_named(states[2], "DiscoveryReader").text, "Complete");
  EXPECT_EQ(row_named(states[0], "received").text, "nothing");
  EXPECT_EQ(row_named(states[2], "received").text, "0–9");
  EXPECT_EQ(row_named(states[0], "DescriptorRepair").text, "U");
  EXPECT_TRUE(row_named(states[1], "received").moved);
  EXPECT_FALSE(row_named(states[2], "received").moved);
}

TEST(Pages, ADiffShowsTheJudgmentFirstThenKnobsCostsAndRuns) {
  const std::string& page = diff_page();
  std::size_t before = page.find("✗ REGRESSION");
  ASSERT_NE(before, std::string::npos);
  for (const char* id : {"knobs", "verdicts", "costs", "margin", "blame", "apart", "repeat"}) {
    const std::size_t here = page.find("id=\"" + std::string{id} + "\"");
    EXPECT_NE(here, std::string::npos) << id;
    EXPECT_LT(before, here) << id;
    before = here;
  }
  EXPECT_EQ(occurrences(page, "class=\"stepper\""), 3U);
  EXPECT_NE(page.find("new.xml:12:34"), std::string::npos);
  EXPECT_NE(page.find("completion at participants_per_host 5"), std::string::npos);
  EXPECT_NE(page.find("75 %"), std::string::npos);
  EXPECT_LT(page.find("id=\"apart-base\""), page.find("id=\"apart-candidate\""));
}

TEST(Pages, EqualProfilesAreSaidToBeEqualAndByWhatProof) {
  const std::string page = to_html(document_of(equality(), {}));
  EXPECT_EQ(html_fault(page), "");
  EXPECT_NE(page.find("✓ NO REGRESSION"), std::string::npos);
  EXPECT_NE(page.find("Every knob has the same value."), std::string::npos);
  EXPECT_EQ(occurrences(page, "class=\"stepper\""), 0U);
}

TEST(Pages, BothColourSchemesHaveReadableContrast) {
  const std::string css{page_style()};
  for (const char* scheme :
       {":root {", ":root:not([data-theme=\"light\"]) {", ":root[data-theme=\"dark\"] {"}) {
    auto colour = colours(css, scheme);
    ASSERT_FALSE(colour.empty()) << scheme;
    for (const char* ink :
         {"--text", "--soft", "--accent", "--good", "--bad", "--warn", "--info"}) {
      EXPECT_GE(contrast(colour[ink], colour["--page"]), 4.5) << scheme << ink;
      EXPECT_GE(contrast(colour[ink], colour["--panel"]), 4.5) << scheme << ink;
    }
    for (const std::string tone : {"--good", "--bad", "--warn", "--info"}) {
      EXPECT_GE(contrast(colour[tone], colour[tone + "-fill"]), 4.5) << scheme << tone;
      EXPECT_GE(contrast(colour["--text"], colour[tone + "-fill"]), 7) << scheme << tone;
    }
  }
  EXPECT_NEAR(contrast("#000000", "#ffffff"), 21, 0.01);
  EXPECT_LT(contrast("#888888", "#ffffff"), 4.5);
}

TEST(Drawings, DoNotActOnEachOtherOrOnThePage) {
  Drawings drawings;
  const std::string svg =
      "<svg width=\"1\">\n<style>\n svg { --ink: #000; }\n @media (prefers-color-scheme: dark) { "
      "svg { --ink: #fff; } }\n .a, .b { marker-end: url(#arrow); } </style>"
      "<defs><marker id=\"arrow\"/></defs><p/></svg>\n";
  const std::string first = drawings.add(svg, "one");
  const std::string second = drawings.add(svg);
  std::string other = svg;
  other.replace(other.find(".b"), 2, ".c");
  static_cast<void>(drawings.add(other));
  EXPECT_EQ(first.find("<svg id=\"one\" class=\"art art-0\""), 0U) << first;
  EXPECT_EQ(second.find("<svg class=\"art art-0\""), 0U);
  EXPECT_EQ(first.find("<style>"), std::string::npos);
  EXPECT_EQ(first.find("<defs>"), std::string::npos);
  const std::string css = drawings.style();
  EXPECT_EQ(occurrences(css, ".art-0 .a, .art-0 .b {"), 1U) << css;
  EXPECT_EQ(occurrences(css, ".art-1 .a, .art-1 .c {"), 1U) << css;
  EXPECT_NE(css.find("url(#art-1-arrow)"), std::string::npos);
  EXPECT_NE(css.find(":root[data-theme=\"dark\"] .art-0 { --ink: #fff; }"), std::string::npos);
  EXPECT_NE(css.find("@media screen and (prefers-color-scheme: dark)"), std::string::npos);
  EXPECT_EQ(css.find("\nsvg {"), std::string::npos);
  EXPECT_EQ(occurrences(drawings.definitions(), "id=\"art-0-arrow\""), 1U);
  EXPECT_EQ(occurrences(drawings.definitions(), "id=\"art-1-arrow\""), 1U);
}

}  // namespace pages_test
}  // namespace stormproof::report
