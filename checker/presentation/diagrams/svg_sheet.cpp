// Splits documents at their known elements, and puts what is left into one.
#include "checker/presentation/diagrams/svg_sheet.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "checker/presentation/diagrams/svg.hpp"

namespace stormproof::draw {

namespace {

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

std::string nested(const PlacedDrawing& placed) {
  return fmt::format(
      "<svg x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" viewBox=\"0 0 {2} {3}\">{4}</svg>\n",
      placed.x, placed.y, placed.drawing.width, placed.drawing.height, placed.drawing.contents);
}

}  // namespace

SvgParts take_apart(const std::string& document) {
  SvgParts parts;
  const std::string_view head = between(document, "<svg", ">");
  parts.width = attribute(head, " width=\"");
  parts.height = attribute(head, " height=\"");
  parts.style = between(document, "<style>", "</style>");
  parts.markers = between(document, "<defs>", "</defs>");
  const std::string_view end = "</defs>";
  const std::size_t from = document.find(end) + end.size();
  parts.contents = document.substr(from, document.rfind("</svg>") - from);
  return parts;
}

std::string svg_sheet(std::string_view title, std::string_view description,
                      const std::vector<PlacedDrawing>& drawings, std::string_view elements) {
  if (drawings.empty()) return {};
  int width = 0;
  int height = 0;
  std::string contents;
  for (const PlacedDrawing& placed : drawings) {
    width = std::max(width, placed.x + placed.drawing.width);
    height = std::max(height, placed.y + placed.drawing.height);
    contents += nested(placed);
  }
  const SvgParts& first = drawings.front().drawing;
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
      "viewBox=\"0 0 {0} {1}\" style=\"--natural: {0}px\" role=\"img\">\n"
      "  <title>{2}</title>\n  <desc>{3}</desc>\n  {4}\n  {5}\n"
      "  <rect width=\"{0}\" height=\"{1}\" class=\"paper\"/>\n{6}{7}</svg>\n",
      width, height, xml_text(title), xml_text(description), first.style, first.markers, contents,
      elements);
}

}  // namespace stormproof::draw
