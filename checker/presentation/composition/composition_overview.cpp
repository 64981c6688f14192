// Two sides that send each other packets stand side by side, with the packets between them; a side
// that sends to its like has an arrow that comes back.
#include "checker/presentation/composition/composition_overview.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "checker/presentation/text/paragraph.hpp"

namespace stormproof::draw {

namespace {

namespace comp = fsm::composition;

constexpr int box_width = 412;
constexpr int left_box = CompositionPen::page_left;
constexpr int right_box = CompositionPen::page_right - box_width;
constexpr int box_padding = 12;
constexpr int packet_distance = 40;

class Overview {
 public:
  Overview(const comp::CompositionInfo& composition, const std::vector<Party>& parties,
           CompositionPen& pen, Svg& svg)
      : composition_{composition}, parties_{parties}, pen_{pen}, svg_{svg} {}

  int run(int y) {
    for (const Party& party : parties_) {
      if (placed_.contains(&party)) continue;
      const Party* other = partner(party);
      const bool swapped = other != nullptr && other->packets.size() > party.packets.size();
      const Party& first = swapped ? *other : party;
      const Party* second = swapped ? &party : other;
      const int height =
          std::max(box_height(first, 0), second == nullptr ? 0 : box_height(*second, 0));
      y = CompositionPen::on_one_page(y, height);
      int bottom = draw_box(first, left_box, y);
      if (second != nullptr) bottom = std::max(bottom, draw_box(*second, right_box, y));
      y = std::max(bottom, draw_packets(first, second, y + 16)) + 16;
      placed_.insert(&first);
      if (second != nullptr) placed_.insert(second);
    }
    return y;
  }

 private:
  [[nodiscard]] bool receives(const Party& party, std::string_view packet) const {
    return std::ranges::any_of(composition_.rules, [&](const comp::RuleInfo& rule) {
      return rule.trigger == "received" && rule.cause == packet &&
             party_of(parties_, rule.id) == &party;
    });
  }
  [[nodiscard]] bool sends_to(const Party& from, const Party& to) const {
    return std::ranges::any_of(from.packets,
                               [&](std::string_view packet) { return receives(to, packet); });
  }
  /// A side that is still to be drawn and that it exchanges packets with.
  [[nodiscard]] const Party* partner(const Party& party) const {
    for (const Party& other : parties_) {
      if (&other == &party || placed_.contains(&other)) continue;
      if (sends_to(party, other) || sends_to(other, party)) return &other;
    }
    return nullptr;
  }

  /// Of one that begins at `top`: ends of pages make it higher.
  [[nodiscard]] int box_height(const Party& party, int top) const {
    Svg scratch{"", ""};
    CompositionPen measuring{composition_, scratch};
    return fill_box(party, 0, top, scratch, measuring) - top;
  }
  /// Returns where it ends.
  int draw_box(const Party& party, int x, int top) {
    svg_.rect(x, top, box_width, box_height(party, top), "side", 8);
    return fill_box(party, x, top, svg_, pen_);
  }

  /// Returns where it ends.
  static int fill_box(const Party& party, int x, int top, Svg& svg, CompositionPen& pen) {
    const int inner = box_width - 2 * box_padding;
    x += box_padding;
    int y = top + 22;
    svg.text(x, y, party.name, "bold");
    y += CompositionPen::line_height + 2;
    int column = 0;  // in which machines stand
    for (const comp::PartInfo& part : party.parts) {
      column = std::max(column, text_width(part.name, CompositionPen::font_size) + 10);
    }
    for (const comp::PartInfo& part : party.parts) {
      svg.text(x, y, part.name, "machine");
      const int rest = text_width(part.machine, CompositionPen::small_size) +
                       text_width(part.owner, CompositionPen::small_size) + 10;
      const bool fits = column + rest <= inner;
      if (!fits) y += CompositionPen::small_line;
      svg.text(x + (fits ? column : 16), y, part.machine, "small");
      svg.text(x + inner, y, part.owner, "quiet small", Anchor::end);
      y += CompositionPen::line_height;
    }
    if (!party.timers.empty()) y = chips(pen, party.timers, x, y - 8, inner);
    if (!party.state.empty()) {
      const auto names = fmt::format("remembers {}", fmt::join(party.state, ", "));
      const auto columns = CompositionPen::columns(inner, CompositionPen::small_size);
      for (const std::string& line : report::wrapped(names, columns, 2)) {
        svg.text(x, y, line, "quiet small");
        y += CompositionPen::small_line;
      }
    }
    y = pen.links(x, y + 2, inner, "rules:", party.rules);
    return y;
  }

  /// Returns the baseline below them.
  static int chips(CompositionPen& pen, const std::vector<std::string_view>& names, int x, int y,
                   int width) {
    int at = x;
    for (const std::string_view name : names) {
      const int needed = CompositionPen::chip_width(name);
      if (at > x && at + needed > x + width) {
        at = x;
        y += CompositionPen::chip_height + 4;
      }
      at += pen.chip(at, y, name) + 6;
    }
    return y + CompositionPen::chip_height + 18;
  }

  int draw_packets(const Party& first, const Party* second, int y) {
    for (const Party* from : {&first, second}) {
      if (from == nullptr) continue;
      for (const std::string_view packet : from->packets) {
        const Party* to = from == &first ? second : &first;
        if (to != nullptr && receives(*to, packet))
          y = draw_arrow(packet, from == &first, y);
        else
          y = draw_loop(packet, *from, from == &first, y);
      }
    }
    return y;
  }

  int draw_arrow(std::string_view packet, bool to_the_right, int y) {
    const int begin = left_box + box_width + 4;
    const int end = right_box - 4;
    const int width = CompositionPen::chip_width(packet);
    pen_.chip((begin + end - width) / 2, y, packet);
    const int line = y + CompositionPen::chip_height + 6;
    svg_.line(to_the_right ? begin : end, line, to_the_right ? end : begin, line, "way into");
    return y + packet_distance;
  }

  int draw_loop(std::string_view packet, const Party& party, bool on_the_left, int y) {
    const int edge = on_the_left ? left_box + box_width : right_box;
    const int out = on_the_left ? 28 : -28;
    const int middle = y + CompositionPen::chip_height / 2;
    svg_.path(fmt::format("M{} {} h{} q{} 0 {} 8 v4 q0 8 {} 8 h{}", edge, middle - 10, out, out / 4,
                          out / 4, -out / 4, -out + (on_the_left ? 4 : -4)),
              "way into");
    const int width = CompositionPen::chip_width(packet);
    const std::string to = "to another " + party.name;
    const int beside = edge + (on_the_left ? 44 : -44 - width);
    pen_.chip(beside, y, packet);
    if (on_the_left) svg_.text(beside + width + 8, y + 13, to, "quiet small");
    return y + packet_distance;
  }

  const comp::CompositionInfo& composition_;
  const std::vector<Party>& parties_;
  CompositionPen& pen_;
  Svg& svg_;
  std::set<const Party*> placed_;
};

}  // namespace

int draw_overview(const comp::CompositionInfo& composition, const std::vector<Party>& parties,
                  CompositionPen& pen, Svg& svg, int top) {
  return Overview{composition, parties, pen, svg}.run(top);
}

}  // namespace stormproof::draw
