// The elements of a document and its style sheet.
#include "checker/presentation/diagrams/svg.hpp"

#include <fmt/format.h>

namespace stormproof::draw {

namespace {

// Colours: ink and paper, a quieter ink, and one colour each for packets, timers and violations.
constexpr std::string_view common_style = R"(
    svg { --paper: #ffffff; --panel: #f4f6f8; --ink: #1c2430; --quiet: #5c6773; --rule: #c3cad2;
          --packet: #1f5fbf; --block: #d5e3f8; --timer: #8a5a00; --change: #1b6e43;
          --bad: #c8102e; --bad-fill: #fbd9de; }
    @media (prefers-color-scheme: dark) {
      svg { --paper: #14181d; --panel: #1d232a; --ink: #e4e8ec; --quiet: #98a3ae; --rule: #3d4650;
            --packet: #7fb0ff; --block: #24406b; --timer: #e3b341; --change: #6fd19c;
            --bad: #ff6b81; --bad-fill: #4d1721; }
    }
    svg:root { max-width: 100%; min-width: calc(.6 * var(--natural)); height: auto; }
    text { font-family: ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace;
           font-size: 12px; fill: var(--ink); white-space: pre; }
    .paper { fill: var(--paper); }
    .title { font-size: 16px; font-weight: 600; }
    .quiet { fill: var(--quiet); }
    .small { font-size: 11px; }
    .bold { font-weight: 600; }
    .head { fill: var(--packet); }
    .head-ink { fill: var(--quiet); }
)";

// Arrow heads, for marker-end.
constexpr std::string_view markers = R"(
    <marker id="arrow" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="8" markerHeight="8"
      orient="auto-start-reverse"><path d="M0 0 L10 5 L0 10 z" class="head"/></marker>
    <marker id="arrow-ink" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="8" markerHeight="8"
      orient="auto-start-reverse"><path d="M0 0 L10 5 L0 10 z" class="head-ink"/></marker>
)";

}  // namespace

std::string xml_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t') result += c;
    }
  }
  return result;
}

int text_width(std::string_view text, int font_size) {
  int half_columns = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80)
      half_columns += 2;
    else if (byte >= 0xc0)
      half_columns += 3;
  }
  return (half_columns * font_size * 31 + 99) / 100;  // 0.62 em a column
}

Svg::Svg(std::string_view title, std::string_view description)
    : title_{title}, description_{description} {}

void Svg::line(int x1, int y1, int x2, int y2, std::string_view classes) {
  elements_ += fmt::format("  <line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" class=\"{}\"/>\n", x1,
                           y1, x2, y2, classes);
}

void Svg::rect(int x, int y, int width, int height, std::string_view classes, int radius) {
  elements_ +=
      fmt::format("  <rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"{}\" class=\"{}\"/>\n",
                  x, y, width, height, radius, classes);
}

void Svg::circle(int x, int y, int radius, std::string_view classes) {
  elements_ +=
      fmt::format("  <circle cx=\"{}\" cy=\"{}\" r=\"{}\" class=\"{}\"/>\n", x, y, radius, classes);
}

void Svg::path(std::string_view data, std::string_view classes) {
  elements_ += fmt::format("  <path d=\"{}\" class=\"{}\"/>\n", data, classes);
}

void Svg::text(int x, int y, std::string_view text, std::string_view classes, Anchor anchor) {
  const char* where = anchor == Anchor::start    ? ""
                      : anchor == Anchor::middle ? " text-anchor=\"middle\""
                                                 : " text-anchor=\"end\"";
  elements_ += fmt::format("  <text x=\"{}\" y=\"{}\" class=\"{}\"{}>{}</text>\n", x, y, classes,
                           where, xml_text(text));
}

void Svg::link(int x, int y, std::string_view text, std::string_view classes, std::string_view to,
               Anchor anchor) {
  elements_ += fmt::format("  <a href=\"#{}\">\n", xml_text(to));
  Svg::text(x, y, text, classes, anchor);
  elements_ += "  </a>\n";
}

void Svg::open_group(std::string_view id, std::string_view classes) {
  elements_ += fmt::format("  <g id=\"{}\" class=\"{}\">\n", xml_text(id), classes);
}

void Svg::close_group() { elements_ += "  </g>\n"; }

std::string Svg::finish(int width, int height, std::string_view style) const {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
      "viewBox=\"0 0 {0} {1}\" style=\"--natural: {0}px\" role=\"img\">\n"
      "  <title>{2}</title>\n  <desc>{3}</desc>\n  <style>{4}{5}  </style>\n"
      "  <defs>{7}  </defs>\n"
      "  <rect width=\"{0}\" height=\"{1}\" class=\"paper\"/>\n{6}</svg>\n",
      width, height, xml_text(title_), xml_text(description_), common_style, style, elements_,
      markers);
}

}  // namespace stormproof::draw
