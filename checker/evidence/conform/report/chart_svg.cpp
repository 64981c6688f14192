// The chart as SVG. Time runs down, not to scale; each row says when. An arrow ends at the row in
// which the assignment has it received; dashed arrows have no known end.
#include <algorithm>

#include <fmt/format.h>

#include "checker/evidence/conform/report/chart.hpp"
#include "checker/evidence/conform/report/names.hpp"
#include "checker/presentation/diagrams/svg.hpp"
#include "checker/presentation/diagrams/wrapped_text.hpp"

namespace stormproof::conform {

namespace {

using Fate = Chart::Arrow::Fate;

constexpr std::string_view style = R"(
    .lane { stroke: var(--rule); stroke-width: 2; }
    .packet { stroke: var(--packet); stroke-width: 1.5; marker-end: url(#arrow); }
    .unknown { stroke: var(--packet); stroke-width: 1.5; stroke-dasharray: 7 4;
               marker-end: url(#arrow); }
    .lost { stroke: var(--bad); stroke-width: 1.5; stroke-dasharray: 5 3; }
    .cross { stroke: var(--bad); stroke-width: 3; }
    .band { fill: var(--bad-fill); }
    .bad { fill: var(--bad); font-weight: 600; }
    .mark { fill: var(--bad); stroke: var(--paper); }
    .on-arrows { paint-order: stroke; stroke: var(--paper); stroke-width: 4px;
                 stroke-linejoin: round; }
    .on-band { stroke: var(--bad-fill); }
)";

constexpr int margin = 24;
constexpr int line_height = 16;
constexpr int time_width = 120;
constexpr int packet_width = 90;
constexpr int sent_height = 38;
constexpr int received_height = 20;
constexpr int least_span = 420;

/// An instant that the chart shows.
struct Row {
  std::int64_t time_ns = 0;
  std::size_t arrow = 0;
  bool is_reception = false;
  int y = 0;  ///< where arrows begin or end
};

class Painter {
 public:
  explicit Painter(const Chart& chart)
      : chart_{chart}, svg_{"✗ " + chart.title, chart.rule + ". " + chart.nearest} {}

  std::string run() && {
    plan_lanes();
    draw_header();
    plan_rows();
    draw_lanes();
    for (std::size_t k = 0; k < chart_.arrows.size(); ++k) draw_arrow(k);
    for (const Row& row : rows_) draw_texts(row);
    return svg_.finish(width_, bottom_ + margin, style);
  }

 private:
  void plan_lanes() {
    int span = least_span;
    for (const Chart::Arrow& arrow : chart_.arrows) {
      span = std::max(span, draw::text_width(arrow.label, 12) + 80);
    }
    const int titles = draw::text_width(chart_.left.title, 12) / 2 +
                       draw::text_width(chart_.right.title, 12) / 2 + 40;
    const int subtitles = draw::text_width(chart_.left.subtitle, 11) / 2 +
                          draw::text_width(chart_.right.subtitle, 11) / 2 + 40;
    span = std::max({span, titles, subtitles});
    const int half = std::max({draw::text_width(chart_.left.title, 12),
                               draw::text_width(chart_.left.subtitle, 11),
                               draw::text_width(chart_.right.title, 12),
                               draw::text_width(chart_.right.subtitle, 11)}) /
                     2;
    left_ = margin + std::max(time_width + packet_width + 36, half);
    right_ = left_ + span;
    width_ = right_ + std::max(half, 40) + margin;
  }

  void paragraph(const std::string& text, std::string_view classes) {
    const auto columns = static_cast<std::size_t>(width_ - 2 * margin) / 8;
    if (text.empty()) return;
    for (const std::string& line : draw::wrapped(text, columns, 2)) {
      svg_.text(margin, top_, line, classes);
      top_ += line_height;
    }
  }

  void draw_header() {
    top_ = margin + 12;
    paragraph("✗ " + chart_.title, "bad");
    top_ += 4;
    paragraph("breaks " + chart_.rule, "");
    if (!chart_.nearest.empty()) paragraph("nearest assignment: " + chart_.nearest, "");
    paragraph(chart_.legend, "quiet");
    top_ += 20;
    const auto title = [&](const Chart::Lane& lane, int x) {
      svg_.text(x, top_, lane.title, "bold", draw::Anchor::middle);
      svg_.text(x, top_ + 15, lane.subtitle, "quiet small", draw::Anchor::middle);
    };
    title(chart_.left, left_);
    title(chart_.right, right_);
    top_ += line_height * 2;
    const int labels = top_ + 4;
    svg_.text(margin + time_width, labels, "sent after", "quiet small", draw::Anchor::end);
    svg_.text(margin + time_width + packet_width, labels, "packet", "quiet small",
              draw::Anchor::end);
  }

  void plan_rows() {
    for (std::size_t k = 0; k < chart_.arrows.size(); ++k) {
      const Chart::Arrow& arrow = chart_.arrows[k];
      rows_.push_back({arrow.sent_ns, k, false, 0});
      if (arrow.arrives()) rows_.push_back({arrow.received_ns, k, true, 0});
    }
    std::ranges::stable_sort(rows_, [](const Row& a, const Row& b) {
      return a.time_ns < b.time_ns || (a.time_ns == b.time_ns && !a.is_reception && b.is_reception);
    });
    int y = top_ + 12;
    for (Row& row : rows_) {
      const int height = row.is_reception ? received_height : sent_height;
      row.y = y + height - 10;
      if (!row.is_reception && chart_.arrows[row.arrow].is_unexplained) {
        svg_.rect(0, y + 4, width_, height, "band");
      }
      y += height;
    }
    bottom_ = y + 12;
  }

  void draw_lanes() {
    for (const int x : {left_, right_}) svg_.line(x, top_ - 8, x, bottom_, "lane");
  }

  [[nodiscard]] const Row& row_of(std::size_t arrow, bool is_reception) const {
    return *std::ranges::find_if(rows_, [&](const Row& row) {
      return row.arrow == arrow && row.is_reception == is_reception;
    });
  }

  void draw_arrow(std::size_t k) {
    const Chart::Arrow& arrow = chart_.arrows[k];
    const int from = arrow.to_right ? left_ : right_;
    const int to = arrow.to_right ? right_ : left_;
    const int y = row_of(k, false).y;
    if (arrow.arrives()) {
      svg_.line(from, y, to, row_of(k, true).y, "packet");
    } else if (arrow.fate == Fate::lost) {
      const int end = from + (to - from) * 3 / 4;
      svg_.line(from, y, end, y, "lost");
      svg_.line(end - 5, y - 5, end + 5, y + 5, "cross");
      svg_.line(end - 5, y + 5, end + 5, y - 5, "cross");
    } else if (arrow.fate == Fate::under_way) {
      svg_.line(from, y, from + (to - from) * 3 / 4, y, "unknown");
    } else {
      svg_.line(from, y, to, y, "unknown");
    }
    if (arrow.is_unexplained) svg_.circle(from, y, 6, "mark");
  }

  void draw_texts(const Row& row) {
    const Chart::Arrow& arrow = chart_.arrows[row.arrow];
    if (row.is_reception) {
      svg_.text(margin + time_width, row.y + 4, milliseconds(row.time_ns), "quiet small",
                draw::Anchor::end);
      svg_.text(margin + time_width + packet_width, row.y + 4,
                arrow.fate == Fate::dropped ? "dropped" : "received", "quiet small",
                draw::Anchor::end);
      return;
    }
    const std::string_view classes = arrow.is_unexplained ? "bad" : "";
    svg_.text(margin + time_width, row.y + 4,
              (arrow.is_unexplained ? "✗ " : "") + milliseconds(row.time_ns), classes,
              draw::Anchor::end);
    svg_.text(margin + time_width + packet_width, row.y + 4, arrow.packet, classes,
              draw::Anchor::end);
    std::string label = arrow.label;
    if (arrow.fate == Fate::lost) label += " — lost";
    if (arrow.fate == Fate::under_way) label += " — still under way";
    svg_.text(arrow.to_right ? left_ + 14 : right_ - 14, row.y - 7, label,
              arrow.is_unexplained ? "on-arrows on-band bad" : "on-arrows",
              arrow.to_right ? draw::Anchor::start : draw::Anchor::end);
  }

  const Chart& chart_;
  draw::Svg svg_;
  std::vector<Row> rows_;
  int left_ = 0;
  int right_ = 0;
  int width_ = 0;
  int top_ = 0;
  int bottom_ = 0;
};

}  // namespace

std::string svg_chart(const Chart& chart) { return Painter{chart}.run(); }

std::string to_svg(const Report& report) {
  const auto& unexplained = report.result.unexplained;
  return unexplained.empty() ? "" : svg_chart(chart_of(report, unexplained.front()));
}

}  // namespace stormproof::conform
