// The chart as text for terminals: lifelines of the participants, an arrow in the row in which a
// packet is sent, and what else happens beside the lifeline at which it does. The network is the
// room between the lifelines.
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "checker/presentation/sequence/chart.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/paragraph.hpp"
#include "checker/presentation/text/time_text.hpp"

namespace stormproof::sequence {

namespace {

using LineKind = Chart::Line::Kind;

constexpr std::size_t area = 70;  ///< columns from the first lifeline to the last
constexpr std::size_t time_columns = 15;
constexpr std::size_t number_columns = 8;

/// `text` as characters, one for each column.
std::vector<std::string> glyphs(std::string_view text) {
  std::vector<std::string> result;
  for (const char c : text) {
    if ((static_cast<unsigned char>(c) & 0xC0U) == 0x80U && !result.empty())
      result.back() += c;
    else
      result.emplace_back(1, c);
  }
  return result;
}

/// At most `width` columns, "…" where something is cut off.
std::string cut(const std::string& text, std::size_t width) {
  std::vector<std::string> characters = glyphs(text);
  if (characters.size() <= width) return text;
  characters.resize(width - 1);
  std::string result;
  for (const std::string& one : characters) result += one;
  return result + "…";
}

class TextPainter {
 public:
  explicit TextPainter(const Chart& chart) : chart_{chart} { place_lanes(); }

  std::string run() && {
    write_heads();
    for (const Chart::Row& row : chart_.rows) write(row);
    const std::string legend = legend_of(chart_);
    if (!legend.empty()) text_ += report::paragraph("  ", legend);
    return std::move(text_);
  }

 private:
  /// Networks stand between their neighbours, and have no lifeline unless only one participant has.
  void place_lanes() {
    const auto drawn = static_cast<std::size_t>(
        std::ranges::count_if(chart_.lanes, [](const auto& lane) { return !lane.network; }));
    const bool all = drawn < 2;
    const std::size_t gaps = std::max<std::size_t>(all ? chart_.lanes.size() : drawn, 2) - 1;
    std::size_t next = 0;
    for (const Chart::Lane& lane : chart_.lanes) {
      const bool shown = all || !lane.network;
      lanes_.push_back({std::min(next * (area - 1) / gaps, area - 1), shown});
      if (shown) {
        ++next;
      } else {
        lanes_.back().x = (2 * next - 1) * (area - 1) / (2 * gaps);
      }
    }
  }

  void write_heads() {
    std::vector<std::string> heads(area, " ");
    const auto shown = static_cast<std::size_t>(std::ranges::count(lanes_, true, &Lane::shown));
    const std::size_t room = area / std::max<std::size_t>(shown, 1) - 1;
    for (std::size_t k = 0; k < lanes_.size(); ++k) {
      if (!lanes_[k].shown) continue;
      const std::vector<std::string> title = glyphs(cut(chart_.lanes[k].title, room));
      const std::size_t centred = lanes_[k].x - std::min(lanes_[k].x, title.size() / 2);
      put(heads, std::min(lanes_[k].x == 0 ? 0 : centred, area - title.size()), title);
    }
    add_line(" ", "ms", chart_.row_number, heads);
  }

  void write(const Chart::Row& row) {
    if (row.kind == Chart::Row::Kind::service) return;
    if (row.kind == Chart::Row::Kind::gap) {
      text_ += report::paragraph(fmt::format("{:{}}⋮ ", "", time_columns + number_columns + 6),
                                 row.text);
      return;
    }
    sign_ = row.violation ? chart_.sign : " ";
    time_ = report::milliseconds(row.time);
    number_ = number_of(row);
    for (const Chart::Line& line : row.lines) {
      if (line.kind == LineKind::sent)
        write_arrow(line);
      else
        write_note(words_of(line), lanes_[line.lane].x);
    }
  }

  /// Where a packet goes, as far as the chart tells, and how its arrow ends.
  struct Way {
    std::size_t lane = 0;
    bool dashed = false;
    std::string head;
  };

  [[nodiscard]] Way way_of(const Chart::Line& sent) const {
    Way way{across(sent.lane), false, "…"};
    for (const std::size_t packet : sent.packets) {
      const Chart::Packet& one = chart_.packets[packet];
      const auto received = find(packet, LineKind::received);
      const bool forward = received.value_or(one.unknown_end.value_or(way.lane)) > sent.lane;
      const std::string head = forward ? "▷" : "◁";
      if (received) return {*received, one.local, head};
      if (one.unknown_end) return {*one.unknown_end, true, head};
      if (find(packet, LineKind::lost)) way.head = "╳";
    }
    return way;
  }

  [[nodiscard]] std::optional<std::size_t> find(std::size_t packet, LineKind kind) const {
    for (const Chart::Row& row : chart_.rows) {
      for (const Chart::Line& line : row.lines) {
        if (line.kind == kind && std::ranges::count(line.packets, packet) > 0) return line.lane;
      }
    }
    return std::nullopt;
  }

  /// The next lifeline towards the network.
  [[nodiscard]] std::size_t across(std::size_t lane) const {
    const auto network = static_cast<std::size_t>(
        std::ranges::find(chart_.lanes, true, &Chart::Lane::network) - chart_.lanes.begin());
    if (lane < network) {
      for (std::size_t k = lane + 1; k < lanes_.size(); ++k) {
        if (lanes_[k].shown) return k;
      }
    }
    for (std::size_t k = lane; k-- > 0;) {
      if (lanes_[k].shown) return k;
    }
    return lane;
  }

  /// "│── ACKNACK 7 … ──▷│"; a label that does not fit stands above its arrow.
  void write_arrow(const Chart::Line& line) {
    const Way way = way_of(line);
    const std::size_t from = lanes_[line.lane].x;
    const std::size_t to = lanes_[way.lane].x;
    if (from == to) return write_note(words_of(line), from);
    const std::size_t first = std::min(from, to) + 1;
    const std::size_t last = std::max(from, to) - 1;
    std::vector<std::string> label = glyphs(" " + words_of(line) + " ");
    if (label.size() + 5 > last - first + 1) {
      write_note(words_of(line), from);
      label.clear();
    }
    std::vector<std::string> cells = lifelines();
    for (std::size_t x = first; x <= last; ++x) cells[x] = way.dashed ? "╌" : "─";
    put(cells, first + (last - first - label.size()) / 2, label);
    cells[to > from ? last : first] = way.head;
    add_line(cells);
  }

  /// Beside a lifeline, on the side on which there is more room.
  void write_note(const std::string& text, std::size_t lane) {
    const bool to_the_right = lane < area / 2;
    const std::size_t room = (to_the_right ? area - lane : lane) - 2;
    for (const std::string& part : report::wrapped(text, room, 2)) {
      std::vector<std::string> cells = lifelines();
      const std::vector<std::string> characters = glyphs(cut(part, room));
      put(cells, to_the_right ? lane + 2 : lane - 1 - characters.size(), characters);
      add_line(cells);
    }
  }

  [[nodiscard]] std::vector<std::string> lifelines() const {
    std::vector<std::string> cells(area, " ");
    for (const Lane& lane : lanes_) {
      if (lane.shown) cells[lane.x] = "│";
    }
    return cells;
  }

  static void put(std::vector<std::string>& cells, std::size_t x,
                  const std::vector<std::string>& characters) {
    for (std::size_t k = 0; k < characters.size() && x + k < cells.size(); ++k) {
      cells[x + k] = characters[k];
    }
  }

  /// Only the first line of a row says when.
  void add_line(const std::vector<std::string>& cells) {
    add_line(sign_, time_, number_, cells);
    sign_ = " ";
    time_.clear();
    number_.clear();
  }
  void add_line(const std::string& sign, const std::string& time, const std::string& number,
                const std::vector<std::string>& cells) {
    std::string line = fmt::format("{} {} {}   ", sign, report::right(time, time_columns),
                                   report::right(number, number_columns));
    for (const std::string& cell : cells) line += cell;
    line.resize(line.find_last_not_of(' ') + 1);
    text_ += line + "\n";
  }

  struct Lane {
    std::size_t x = 0;  ///< in the area
    bool shown = false;
  };

  const Chart& chart_;
  std::vector<Lane> lanes_;
  std::string text_;
  std::string sign_;  // of the row that is being written, until its first line is
  std::string time_;
  std::string number_;
};

}  // namespace

std::string text_chart(const Chart& chart) { return TextPainter{chart}.run(); }

}  // namespace stormproof::sequence
