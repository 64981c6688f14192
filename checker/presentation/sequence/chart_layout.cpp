// Widths first, then rows, then the columns in which channels serve.
#include "checker/presentation/sequence/chart_layout.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "checker/presentation/diagrams/svg.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/paragraph.hpp"
#include "checker/presentation/text/time_text.hpp"

namespace stormproof::sequence {

namespace {

using Kind = Chart::Row::Kind;

constexpr std::size_t text_columns = 40;
constexpr std::size_t most_beside = 4;  // blocks of one channel
constexpr std::size_t channel_text_columns = 30;
constexpr int gutter = 12;    // between a lane and its texts
constexpr int crossing = 56;  // between a participant and the channels, for arrows
constexpr int row_gap = 8;

int width_of(std::string_view text) { return draw::text_width(text, ChartLayout::font_size); }

class Planner {
 public:
  explicit Planner(const Chart& chart) : chart_{chart} {}

  ChartLayout run() && {
    layout_.lanes.resize(chart_.lanes.size());
    break_texts();
    measure_columns();
    place_lanes();
    write_header();
    place_rows();
    place_blocks();
    return std::move(layout_);
  }

 private:
  void break_texts() {
    for (const Chart::Row& row : chart_.rows) {
      ChartLayout::Row& placed = layout_.rows.emplace_back();
      for (std::size_t k = 0; k < row.lines.size(); ++k) {
        const bool network = chart_.lanes[row.lines[k].lane].network;
        placed.texts.push_back({k, 0,
                                report::wrapped(words_of(row.lines[k]),
                                                network ? channel_text_columns : text_columns, 2)});
      }
    }
  }

  void measure_columns() {
    layout_.time_width = width_of(chart_.row_number) + gutter + width_of("0.000000 ms");
    for (std::size_t k = 0; k < chart_.lanes.size(); ++k) {
      const Chart::Lane& lane = chart_.lanes[k];
      layout_.lanes[k].width = std::max(width_of(lane.title), width_of(lane.subtitle)) + 2 * gutter;
    }
    std::vector<int> notes(chart_.lanes.size(), 0);
    for (std::size_t r = 0; r < chart_.rows.size(); ++r) {
      const int time = width_of(number_of(chart_.rows[r])) + gutter +
                       width_of(report::milliseconds(chart_.rows[r].time));
      layout_.time_width = std::max(layout_.time_width, time);
      for (const ChartLayout::Text& text : layout_.rows[r].texts) {
        const std::size_t lane = chart_.rows[r].lines[text.line].lane;
        for (const std::string& part : text.parts) {
          notes[lane] = std::max(notes[lane], width_of(part));
        }
      }
    }
    assign_block_columns();
    for (std::size_t k = 0; k < chart_.lanes.size(); ++k) {
      ChartLayout::Lane& lane = layout_.lanes[k];
      if (!chart_.lanes[k].network) {
        lane.width = std::max(lane.width, notes[k] + 2 * gutter);
        continue;
      }
      const int blocks = lane.block_width * static_cast<int>(block_columns_[k]);
      note_width_.push_back(notes[k]);
      lane.width =
          std::max(lane.width, blocks + (notes[k] > 0 ? notes[k] + gutter : 0)) + 2 * gutter;
    }
  }

  /// Blocks that overlap in time stand side by side.
  void assign_block_columns() {
    block_columns_.assign(chart_.lanes.size(), 1);
    struct Ref {
      std::size_t packet;
      std::size_t block;
    };
    std::vector<Ref> order;
    for (std::size_t p = 0; p < chart_.packets.size(); ++p) {
      column_.emplace_back(chart_.packets[p].blocks.size());
      for (std::size_t b = 0; b < chart_.packets[p].blocks.size(); ++b) order.push_back({p, b});
    }
    const auto at = [&](const Ref& ref) -> const Chart::Block& {
      return chart_.packets[ref.packet].blocks[ref.block];
    };
    std::ranges::stable_sort(order, {}, [&](const Ref& ref) { return at(ref).first_row; });
    std::vector<std::vector<std::size_t>> busy_until(chart_.lanes.size());
    for (const Ref& ref : order) {
      const Chart::Block& block = at(ref);
      auto& columns = busy_until[block.lane];
      const auto free = std::ranges::find_if(
          columns, [&](std::size_t until) { return until <= block.first_row; });
      column_[ref.packet][ref.block] = static_cast<std::size_t>(free - columns.begin());
      if (free == columns.end() && columns.size() == most_beside) {
        ++undrawn_;
        continue;
      }
      const std::size_t until = std::max(block.last_row, block.first_row + 1);
      if (free == columns.end())
        columns.push_back(until);
      else
        *free = until;
      block_columns_[block.lane] = std::max(block_columns_[block.lane], columns.size());
      ChartLayout::Lane& lane = layout_.lanes[block.lane];
      lane.block_width = std::max(
          lane.block_width, width_of(block_text(chart_.packets[ref.packet], block)) + 2 * gutter);
    }
  }

  void place_lanes() {
    int x = ChartLayout::margin + layout_.time_width + 2 * gutter;
    bool before_network = true;
    std::size_t network = 0;
    for (std::size_t k = 0; k < chart_.lanes.size(); ++k) {
      ChartLayout::Lane& lane = layout_.lanes[k];
      if (chart_.lanes[k].network) {
        x += before_network ? crossing : gutter;
        before_network = false;
        lane.left = x;
        lane.x = x + lane.width / 2;
        lane.blocks_left = x + gutter;
        lane.notes_left = x + lane.width - gutter - note_width_[network++];
        const bool last = k + 1 == chart_.lanes.size() || !chart_.lanes[k + 1].network;
        x += lane.width + (last ? crossing : 0);
        continue;
      }
      lane.left = x;
      lane.text_left = before_network;
      lane.x = before_network ? x + lane.width : x;
      x += lane.width + gutter;
    }
    layout_.width = std::max(x + ChartLayout::margin, 640);
  }

  void write_header() {
    const auto columns = static_cast<std::size_t>(layout_.width - 2 * ChartLayout::margin) /
                         static_cast<std::size_t>(width_of("m"));
    const auto add = [&](const std::string& text) {
      if (text.empty()) return;
      for (std::string& line : report::wrapped(text, columns, 2)) {
        layout_.header.push_back(std::move(line));
      }
    };
    for (const std::string& line : chart_.header) add(line);
    add(legend_of(chart_));
    const auto waits = [](const Chart::Packet& packet) { return packet.blocks.size() > 1; };
    if (std::ranges::any_of(chart_.packets, waits)) {
      add("boxes: a channel serves the packet; dotted lines: it waits for the next stage");
    }
    if (undrawn_ > 0) {
      add(fmt::format("a channel has room for {} packets at a time here; {} more are not drawn",
                      most_beside, undrawn_));
    }
    layout_.top = ChartLayout::margin + 28 +
                  ChartLayout::line_height * static_cast<int>(layout_.header.size()) + 60;
  }

  /// Columns between the margin and the first channel.
  [[nodiscard]] std::size_t gap_columns() const {
    int right = layout_.width;
    for (std::size_t k = 0; k < chart_.lanes.size(); ++k) {
      if (chart_.lanes[k].network) right = std::min(right, layout_.lanes[k].left);
    }
    return static_cast<std::size_t>((right - ChartLayout::margin) / width_of("m"));
  }

  void place_rows() {
    int y = layout_.top;
    for (std::size_t r = 0; r < chart_.rows.size(); ++r) {
      ChartLayout::Row& row = layout_.rows[r];
      row.y = y;
      std::vector<int> used(chart_.lanes.size(), 0);
      for (ChartLayout::Text& text : row.texts) {
        int& lines = used[chart_.rows[r].lines[text.line].lane];
        text.y = y + 13 + lines * ChartLayout::line_height;
        lines += static_cast<int>(text.parts.size());
      }
      const int most = used.empty() ? 0 : *std::ranges::max_element(used);
      switch (chart_.rows[r].kind) {
        case Kind::event:
          row.height = std::max(1, most) * ChartLayout::line_height + row_gap;
          break;
        case Kind::service:
          row.height = ChartLayout::line_height;
          break;
        case Kind::gap:
          row.gap = report::wrapped("⋮ " + chart_.rows[r].text, gap_columns(), 2);
          row.height = ChartLayout::line_height * (static_cast<int>(row.gap.size()) + 1);
          break;
      }
      y += row.height;
    }
    layout_.bottom = y;
  }

  void place_blocks() {
    for (std::size_t p = 0; p < chart_.packets.size(); ++p) {
      auto& placed = layout_.blocks.emplace_back();
      for (std::size_t b = 0; b < chart_.packets[p].blocks.size(); ++b) {
        if (column_[p][b] == most_beside) continue;
        const Chart::Block& block = chart_.packets[p].blocks[b];
        const ChartLayout::Lane& lane = layout_.lanes[block.lane];
        const int top = layout_.rows[block.first_row].y + 4;
        int bottom = block.finished ? layout_.rows[block.last_row].y + 2 : layout_.bottom;
        bottom = std::max(bottom, top + 12);
        placed.push_back({b, lane.blocks_left + static_cast<int>(column_[p][b]) * lane.block_width,
                          top, lane.block_width - 4, bottom - top});
      }
    }
  }

  const Chart& chart_;
  ChartLayout layout_;
  std::vector<std::size_t> block_columns_;        // by lane
  std::vector<std::vector<std::size_t>> column_;  // by packet and block
  std::vector<int> note_width_;                   // by network lane
  std::size_t undrawn_ = 0;                       // blocks
};

}  // namespace

ChartLayout layout_of(const Chart& chart) { return Planner{chart}.run(); }

std::string block_text(const Chart::Packet& packet, const Chart::Block& block) {
  return packet.name + " " + block.stage;
}

}  // namespace stormproof::sequence
