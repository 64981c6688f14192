// Two sequence charts become one drawing: each is an <svg> of its own inside the outer one. Their
// style sheet and their arrow heads are the same, so the drawing has them once, and no id twice.
#include "checker/experiments/diff/paired_charts.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include <fmt/format.h>

#include "checker/presentation/diagrams/svg.hpp"
#include "checker/verification/counterexample/chart.hpp"

namespace stormproof::diff {

namespace {

/// A document of `svg_chart`, taken apart.
struct Drawing {
  int width = 0;
  int height = 0;
  std::string style;     ///< the <style> element
  std::string markers;   ///< the <defs> element
  std::string contents;  ///< all other elements
};

std::string_view between(std::string_view text, std::string_view first, std::string_view last) {
  const std::size_t from = text.find(first);
  const std::size_t to = from == std::string_view::npos ? from : text.find(last, from);
  return to == std::string_view::npos ? std::string_view{}
                                      : text.substr(from, to + last.size() - from);
}

int attribute(std::string_view text, std::string_view name) {
  const std::size_t at = text.find(name);
  int value = 0;
  if (at == std::string_view::npos) return value;
  const std::string_view digits = text.substr(at + name.size());
  static_cast<void>(std::from_chars(digits.data(), digits.data() + digits.size(), value));
  return value;
}

Drawing take_apart(const std::string& document) {
  Drawing drawing;
  const std::string_view head = between(document, "<svg", ">");
  drawing.width = attribute(head, " width=\"");
  drawing.height = attribute(head, " height=\"");
  drawing.style = between(document, "<style>", "</style>");
  drawing.markers = between(document, "<defs>", "</defs>");
  const std::string_view end = "</defs>";
  const std::size_t from = document.find(end) + end.size();
  drawing.contents = document.substr(from, document.rfind("</svg>") - from);
  return drawing;
}

Drawing draw(const props::Counterexample& run, const std::vector<std::uint64_t>& packets,
             std::string_view side, std::string_view name) {
  counterexample::Chart chart = counterexample::chart_of(run, packets);
  chart.title = name.empty() ? std::string{side} : fmt::format("{}: {}", side, name);
  chart.closing = "Here the runs part";
  chart.sign = "≠";
  return take_apart(counterexample::svg_chart(chart));
}

std::string nested(const Drawing& drawing, int y) {
  return fmt::format(
      "<svg x=\"0\" y=\"{0}\" width=\"{1}\" height=\"{2}\" viewBox=\"0 0 {1} {2}\">{3}</svg>\n", y,
      drawing.width, drawing.height, drawing.contents);
}

}  // namespace

std::string paired_charts_svg(const TellingApart& apart, std::string_view base_name,
                              std::string_view candidate_name) {
  if (!apart.found) return {};
  const Drawing above = draw(apart.base_run, apart.base_packets, "Base", base_name);
  const Drawing below =
      draw(apart.candidate_run, apart.candidate_packets, "Candidate", candidate_name);
  const int width = std::max(above.width, below.width);
  const int height = above.height + below.height;
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
      "viewBox=\"0 0 {0} {1}\" role=\"img\">\n"
      "  <title>The least scenario that tells the profiles apart</title>\n  <desc>{2}</desc>\n"
      "  {3}\n  {4}\n  <rect width=\"{0}\" height=\"{1}\" class=\"paper\"/>\n{5}"
      "  <line x1=\"0\" y1=\"{6}\" x2=\"{0}\" y2=\"{6}\" class=\"lane\"/>\n{7}</svg>\n",
      width, height, draw::xml_text(apart.difference), above.style, above.markers, nested(above, 0),
      above.height, nested(below, above.height));
}

}  // namespace stormproof::diff
