// The chart as SVG. Time runs down, not to scale; each row says when. A page that steps through the
// chart finds row K as the element of classes `row rK`, and what draws packet K as `wK`.
#include <algorithm>

#include <fmt/format.h>

#include "checker/presentation/diagrams/svg.hpp"
#include "checker/presentation/sequence/chart.hpp"
#include "checker/presentation/sequence/chart_layout.hpp"
#include "checker/presentation/text/paragraph.hpp"
#include "checker/presentation/text/time_text.hpp"

namespace stormproof::sequence {

namespace {

using LineKind = Chart::Line::Kind;

constexpr std::string_view style = R"(
    .row { fill: none; }
    .lane { stroke: var(--rule); stroke-width: 2; }
    .channel { fill: var(--panel); stroke: var(--rule); }
    .packet { stroke: var(--packet); stroke-width: 1.5; marker-end: url(#arrow); }
    .pending { stroke: var(--packet); stroke-width: 1.5; stroke-dasharray: 3 3; }
    .local, .unknown { stroke-dasharray: 7 4; }
    .doomed { stroke: var(--bad); stroke-width: 1.5; stroke-dasharray: 5 3; }
    .cross { stroke: var(--bad); stroke-width: 3; }
    .block { fill: var(--block); stroke: var(--packet); }
    .tick { fill: var(--paper); stroke: var(--timer); stroke-width: 2; }
    .band { fill: var(--bad-fill); }
    .verdict { fill: var(--bad-fill); stroke: var(--bad); stroke-width: 2; }
    .mark { fill: var(--bad); stroke: var(--paper); }
    .bad { fill: var(--bad); font-weight: 600; }
    .timer { fill: var(--timer); }
    .sent, .received { fill: var(--packet); }
    .change { fill: var(--change); }
    .on-lanes { paint-order: stroke; stroke: var(--paper); stroke-width: 4px;
                stroke-linejoin: round; }
    .on-channel { stroke: var(--panel); }
)";

const char* class_of(LineKind kind) {
  switch (kind) {
    case LineKind::timer:
      return "timer";
    case LineKind::sent:
      return "sent";
    case LineKind::received:
      return "received";
    case LineKind::lost:
    case LineKind::unexplained:
      return "bad";
    case LineKind::change:
      return "change";
    case LineKind::service:
      return "quiet";
  }
  return "";
}

class Painter {
 public:
  explicit Painter(const Chart& chart)
      : chart_{chart}, layout_{layout_of(chart)}, svg_{chart.title, chart.reason} {}

  std::string run() && {
    draw_violation_band();
    draw_lanes();
    draw_row_areas();
    for (std::size_t p = 0; p < chart_.packets.size(); ++p) draw_way(p);
    for (std::size_t p = 0; p < chart_.packets.size(); ++p) draw_blocks(p);
    draw_header();
    for (std::size_t r = 0; r < chart_.rows.size(); ++r) draw_row(r);
    const int height = draw_verdict();
    return svg_.finish(layout_.width, height, style);
  }

 private:
  struct Point {
    int x = 0;
    int y = 0;
  };

  void draw_header() {
    int y = ChartLayout::margin + 14;
    svg_.text(ChartLayout::margin, y, chart_.sign + " " + chart_.title, "title bad");
    y += 24;
    for (const std::string& line : layout_.header) {
      svg_.text(ChartLayout::margin, y, line, "quiet");
      y += ChartLayout::line_height;
    }
    const int labels = layout_.top - 34;
    svg_.text(ChartLayout::margin, labels + 15, chart_.row_number, "quiet small");
    svg_.text(ChartLayout::margin + layout_.time_width, labels + 15, "ms", "quiet small",
              draw::Anchor::end);
    for (std::size_t k = 0; k < chart_.lanes.size(); ++k) {
      const ChartLayout::Lane& lane = layout_.lanes[k];
      const auto anchor = chart_.lanes[k].network ? draw::Anchor::middle
                          : lane.text_left        ? draw::Anchor::end
                                                  : draw::Anchor::start;
      svg_.text(lane.x, labels, chart_.lanes[k].title, "bold", anchor);
      svg_.text(lane.x, labels + 15, chart_.lanes[k].subtitle, "quiet small", anchor);
    }
  }

  void draw_lanes() {
    const int top = layout_.top - 10;
    for (std::size_t k = 0; k < chart_.lanes.size(); ++k) {
      const ChartLayout::Lane& lane = layout_.lanes[k];
      if (chart_.lanes[k].network)
        svg_.rect(lane.left, top, lane.width, layout_.bottom - top, "channel", 6);
      else
        svg_.line(lane.x, top, lane.x, layout_.bottom, "lane");
    }
  }

  void draw_violation_band() {
    for (std::size_t r = 0; r < chart_.rows.size(); ++r) {
      if (!chart_.rows[r].violation) continue;
      svg_.rect(0, layout_.rows[r].y - 3, layout_.width, layout_.rows[r].height, "band");
    }
  }

  /// Nothing to see: what a page marks.
  void draw_row_areas() {
    for (std::size_t r = 0; r < chart_.rows.size(); ++r) {
      svg_.rect(0, layout_.rows[r].y - 3, layout_.width, layout_.rows[r].height,
                fmt::format("row r{}", r));
    }
  }

  void draw_row(std::size_t r) {
    const Chart::Row& row = chart_.rows[r];
    const ChartLayout::Row& placed = layout_.rows[r];
    const int baseline = placed.y + 13;
    if (row.kind == Chart::Row::Kind::gap) {
      int y = placed.y + 18;
      for (const std::string& line : placed.gap) {
        svg_.text(ChartLayout::margin, y, line, "quiet on-lanes");
        y += ChartLayout::line_height;
      }
      return;
    }
    const bool event = row.kind == Chart::Row::Kind::event;
    const std::string classes = row.violation ? "bad" : event ? "" : "quiet small";
    if (event) {
      svg_.text(ChartLayout::margin, baseline, (row.violation ? chart_.sign : "") + number_of(row),
                classes);
    }
    if (r == 0 || chart_.rows[r - 1].time != row.time || event) {
      svg_.text(ChartLayout::margin + layout_.time_width, baseline, report::milliseconds(row.time),
                classes, draw::Anchor::end);
    }
    for (const ChartLayout::Text& text : placed.texts) draw_text(row, row.lines[text.line], text);
  }

  void draw_text(const Chart::Row& row, const Chart::Line& line, const ChartLayout::Text& text) {
    const ChartLayout::Lane& lane = layout_.lanes[line.lane];
    const bool network = chart_.lanes[line.lane].network;
    if (line.kind == LineKind::timer) svg_.circle(lane.x, text.y - 4, 5, "tick");
    if (row.violation && &line == &row.lines.front() && !network) {
      svg_.circle(lane.x, text.y - 4, 7, "mark");
    }
    std::string classes = class_of(line.kind);
    if (!row.violation) classes += network ? " on-lanes on-channel" : " on-lanes";
    int y = text.y;
    for (const std::string& part : text.parts) {
      const int gutter = 12;
      if (network)
        svg_.text(lane.notes_left, y, part, classes);
      else if (lane.text_left)
        svg_.text(lane.x - gutter, y, part, classes, draw::Anchor::end);
      else
        svg_.text(lane.x + gutter, y, part, classes);
      y += ChartLayout::line_height;
    }
  }

  /// The lines of the rows that are about a packet, as points on their lanes.
  [[nodiscard]] std::vector<Point> points(std::size_t packet, LineKind kind) const {
    std::vector<Point> found;
    for (std::size_t r = 0; r < chart_.rows.size(); ++r) {
      for (const ChartLayout::Text& text : layout_.rows[r].texts) {
        const Chart::Line& line = chart_.rows[r].lines[text.line];
        if (line.kind == kind && std::ranges::count(line.packets, packet) > 0) {
          found.push_back({layout_.lanes[line.lane].x, text.y - 4});
        }
      }
    }
    return found;
  }

  /// Where a way from or to `x` meets a block.
  static int edge(const ChartLayout::Block& block, int x) {
    return x < block.x ? block.x : block.x + block.width;
  }

  /// Of the packet whose way is being drawn.
  void arrow(Point from, Point to, const char* classes) {
    svg_.line(from.x, from.y, to.x, to.y, fmt::format("{} w{}", classes, packet_));
  }
  void cross(Point at) {
    svg_.line(at.x - 6, at.y - 6, at.x + 6, at.y + 6, "cross");
    svg_.line(at.x - 6, at.y + 6, at.x + 6, at.y - 6, "cross");
  }

  [[nodiscard]] const ChartLayout::Lane& network() const {
    for (std::size_t k = 0; k < chart_.lanes.size(); ++k) {
      if (chart_.lanes[k].network) return layout_.lanes[k];
    }
    return layout_.lanes.front();
  }

  void draw_way(std::size_t p) {
    packet_ = p;
    const auto sent = points(p, LineKind::sent);
    const auto received = points(p, LineKind::received);
    const auto lost = points(p, LineKind::lost);
    const auto& blocks = layout_.blocks[p];
    if (blocks.empty()) {
      draw_direct_way(sent, received, lost, chart_.packets[p]);
      return;
    }
    for (const Point from : sent) {
      arrow(from, {edge(blocks.front(), from.x), blocks.front().y + 6}, "packet");
    }
    for (std::size_t b = 1; b < blocks.size(); ++b) {
      const ChartLayout::Block& before = blocks[b - 1];
      arrow({before.x + before.width / 2, before.y + before.height},
            {blocks[b].x + blocks[b].width / 2, blocks[b].y}, "pending");
    }
    const ChartLayout::Block& last = blocks.back();
    for (const Point to : received) {
      arrow({edge(last, to.x), last.y + last.height - 3}, to, "packet");
    }
    for (const Point at : lost) cross({last.x + last.width / 2, at.y});
  }

  /// Constant delay, a packet that no channel has served yet, or one that stays on its host.
  void draw_direct_way(const std::vector<Point>& sent, const std::vector<Point>& received,
                       const std::vector<Point>& lost, const Chart::Packet& packet) {
    const ChartLayout::Lane& middle = network();
    const bool local = packet.local;
    for (const Point at : lost) {
      for (const Point from : sent) arrow(from, {middle.left + 12, at.y}, "doomed");
      cross({middle.left + 12, at.y});
    }
    for (const Point to : received) {
      for (const Point from : sent) arrow(from, to, local ? "packet local" : "packet");
      if (sent.empty() && !local) arrow({middle.x, to.y}, to, "packet");
    }
    if (!received.empty() || !lost.empty()) return;
    for (const Point from : sent) {
      if (packet.unknown_end) {
        arrow(from, {layout_.lanes[*packet.unknown_end].x, from.y}, "packet unknown");
        continue;
      }
      const int stub = from.x < middle.x ? 36 : -36;
      arrow(from, {from.x + stub, from.y}, "pending");
      svg_.circle(from.x + stub, from.y, 3, "block");
    }
  }

  void draw_blocks(std::size_t p) {
    for (std::size_t b = 0; b < layout_.blocks[p].size(); ++b) {
      const ChartLayout::Block& block = layout_.blocks[p][b];
      svg_.rect(block.x, block.y, block.width, block.height, fmt::format("block w{}", p), 3);
      svg_.text(block.x + block.width / 2, block.y + block.height / 2 + 4,
                block_text(chart_.packets[p], chart_.packets[p].blocks[block.block]), "small",
                draw::Anchor::middle);
    }
  }

  /// The reason, below everything; returns the height of the drawing.
  int draw_verdict() {
    if (chart_.reason.empty()) return layout_.bottom + ChartLayout::margin;
    const int width = layout_.width - 2 * ChartLayout::margin;
    const auto columns = static_cast<std::size_t>(width - 32) /
                         static_cast<std::size_t>(draw::text_width("m", ChartLayout::font_size));
    const auto lines = report::wrapped(chart_.reason, columns);
    const int top = layout_.bottom + 16;
    const int height = 40 + ChartLayout::line_height * static_cast<int>(lines.size());
    svg_.rect(ChartLayout::margin, top, width, height, "verdict", 6);
    int y = top + 22;
    svg_.text(ChartLayout::margin + 16, y, chart_.sign + " " + chart_.closing, "bad");
    for (const std::string& line : lines) {
      y += ChartLayout::line_height;
      svg_.text(ChartLayout::margin + 16, y, line, "");
    }
    return top + height + ChartLayout::margin;
  }

  const Chart& chart_;
  const ChartLayout layout_;
  draw::Svg svg_;
  std::size_t packet_ = 0;  // whose way is being drawn
};

}  // namespace

std::string svg_chart(const Chart& chart) { return Painter{chart}.run(); }

}  // namespace stormproof::sequence
