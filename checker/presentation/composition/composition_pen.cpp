// Chips and links.
#include "checker/presentation/composition/composition_pen.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "checker/presentation/charts/canvas.hpp"
#include "checker/presentation/composition/composition_graph.hpp"

namespace stormproof::draw {

namespace {

constexpr int chip_padding = 8;
constexpr int page_height = 748;  // pixels of 1/96 inch: 210 mm less twice 6 mm
constexpr int page_top = 8;       // nothing touches the edge

std::optional<std::size_t> place_of(const std::vector<fsm::composition::ThingInfo>& things,
                                    std::string_view name) {
  const auto found = std::ranges::find(things, name, &fsm::composition::ThingInfo::name);
  if (found == things.end()) return std::nullopt;
  return static_cast<std::size_t>(found - things.begin());
}

}  // namespace

int CompositionPen::chip_width(std::string_view name) {
  return text_width(name, font_size) + 2 * chip_padding;
}

int CompositionPen::chip(int x, int y, std::string_view name) {
  const int width = chip_width(name);
  std::string shape = "occasion";
  std::string text = "quiet";
  int radius = 0;
  if (const auto packet = place_of(composition_.packets, name)) {
    shape = plot::fill_class(*packet);
    text = "on-packet";
    radius = 3;
  } else if (const auto timer = place_of(composition_.timers, name)) {
    shape = "pill " + plot::stroke_class(*timer);
    text = plot::fill_class(*timer);
    radius = chip_height / 2;
  }
  svg_.rect(x, y, width, chip_height, shape, radius);
  const auto handlers = handlers_of(composition_, name);
  if (handlers.empty())
    svg_.text(x + chip_padding, y + 13, name, text);
  else
    svg_.link(x + chip_padding, y + 13, name, text, element_id(handlers.front()));
  return width;
}

int CompositionPen::links(int x, int y, int width, std::string_view before,
                          const std::vector<std::string>& names) {
  const auto next_line = [&] {
    y = on_one_page(y + small_line - small_size, small_line) + small_size;
  };
  int at = x;
  if (!before.empty()) {
    svg_.text(at, y, before, "quiet small");
    at += text_width(std::string{before} + " ", small_size);
  }
  for (std::size_t k = 0; k < names.size(); ++k) {
    std::string text = names[k] + (k + 1 < names.size() ? "," : "");
    const int needed = text_width(text, small_size);
    if (at > x && at + needed > x + width) {
      at = x;
      next_line();
    }
    // A procedure with what it is called with can be longer than a line.
    if (const std::size_t space = text.find(' '); needed > width && space != std::string::npos) {
      svg_.link(at, y, text.substr(0, space), "small link", element_id(names[k]));
      text.erase(0, space + 1);
      next_line();
    }
    svg_.link(at, y, text, "small link", element_id(names[k]));
    at += text_width(text + " ", small_size);
  }
  return y + small_line;
}

int CompositionPen::lines(int x, int y, const std::vector<std::string>& texts,
                          std::string_view classes) {
  for (const std::string& text : texts) {
    svg_.text(x, y, text, classes);
    y += line_height;
  }
  return y;
}

int CompositionPen::on_one_page(int y, int height) {
  const int next = (y / page_height + 1) * page_height;
  const bool fits = y + height <= next || height > page_height - page_top;
  return fits ? y : next + page_top;
}

std::size_t CompositionPen::columns(int width, int size) {
  return static_cast<std::size_t>(std::max(1, (100 * width - 99) / (62 * size)));
}

std::string CompositionPen::element_id(std::string_view id) {
  std::string name{id};
  std::ranges::replace(name, ' ', '-');
  return name;
}

std::string CompositionPen::style() {
  return plot::palette_style() + R"(
    .pill { fill: var(--paper); stroke-width: 1.5; }
    .occasion { fill: var(--paper); stroke: var(--quiet); stroke-dasharray: 3 2; }
    .on-packet { fill: var(--paper); font-weight: 600; }
    .link { fill: var(--packet); }
    .side { fill: var(--panel); stroke: var(--rule); }
    .machine { fill: var(--change); }
    .way { fill: none; stroke: var(--quiet); stroke-width: 1.5; }
    .into { marker-end: url(#arrow-ink); }
    a:hover text { text-decoration: underline; }
    @page { size: A4 landscape; margin: 6mm; }
)";
}

}  // namespace stormproof::draw
