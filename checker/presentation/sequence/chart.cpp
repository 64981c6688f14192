// What all renderings of a chart say in the same words.
#include "checker/presentation/sequence/chart.hpp"

#include <algorithm>
#include <utility>

namespace stormproof::sequence {

std::string with_effect(const std::string& text, const std::string& effect) {
  return effect.empty() ? text : text + " [" + effect + "]";
}

std::string words_of(const Chart::Line& line) { return with_effect(line.text, line.effect); }

std::string number_of(const Chart::Row& row) {
  if (row.kind == Chart::Row::Kind::gap) return {};
  return row.packet.empty() ? std::to_string(row.event) : row.packet;
}

std::string legend_of(const Chart& chart) {
  std::string text = chart.legend;
  const auto add = [&text](const char* words) {
    text += (text.empty() ? "" : "; ") + std::string{words};
  };
  if (std::ranges::any_of(chart.packets, &Chart::Packet::local)) {
    add("dashed arrows: packets that stay on their host");
  }
  if (std::ranges::any_of(chart.packets,
                          [](const auto& one) { return one.unknown_end.has_value(); })) {
    add("dashed arrows: nobody knows whether the packet arrives");
  }
  return text;
}

namespace {

bool is_same_lane(const Chart::Lane& a, const Chart::Lane& b) {
  return a.title == b.title && a.network == b.network;
}

/// The lanes of a chart, of which `lanes` has each, become these.
void take_lanes(Chart& chart, const std::vector<Chart::Lane>& lanes) {
  std::vector<std::size_t> place;
  for (const Chart::Lane& lane : chart.lanes) {
    const auto there = std::ranges::find_if(
        lanes, [&](const Chart::Lane& one) { return is_same_lane(one, lane); });
    place.push_back(static_cast<std::size_t>(there - lanes.begin()));
  }
  chart.lanes = lanes;
  for (Chart::Row& row : chart.rows) {
    for (Chart::Line& line : row.lines) line.lane = place[line.lane];
  }
  for (Chart::Packet& packet : chart.packets) {
    for (Chart::Block& block : packet.blocks) block.lane = place[block.lane];
    for (auto* end : {&packet.sender, &packet.unknown_end}) {
      if (*end) *end = place[**end];
    }
  }
}

}  // namespace

void share_lanes(Chart& first, Chart& second) {
  std::vector<Chart::Lane> lanes = first.lanes;
  for (const Chart::Lane& lane : second.lanes) {
    const auto is_this = [&](const Chart::Lane& one) { return is_same_lane(one, lane); };
    if (std::ranges::none_of(lanes, is_this)) lanes.push_back(lane);
  }
  take_lanes(first, lanes);
  take_lanes(second, lanes);
}

std::size_t common_rows(const Chart& one, const Chart& other) {
  if (!std::ranges::equal(one.lanes, other.lanes, is_same_lane)) return 0;
  const auto lines = [](const Chart::Line& a, const Chart::Line& b) {
    return a.kind == b.kind && a.lane == b.lane && words_of(a) == words_of(b);
  };
  const auto rows = [&](const Chart::Row& a, const Chart::Row& b) {
    return a.kind == b.kind && a.event == b.event && a.time == b.time && a.text == b.text &&
           a.violation == b.violation && std::ranges::equal(a.lines, b.lines, lines);
  };
  return static_cast<std::size_t>(std::ranges::mismatch(one.rows, other.rows, rows).in1 -
                                  one.rows.begin());
}

void fold_start(Chart& chart, std::size_t rows, std::string text) {
  if (rows == 0) return;
  Chart::Row gap = chart.rows.front();
  gap.kind = Chart::Row::Kind::gap;
  gap.lines.clear();
  gap.text = std::move(text);
  chart.rows.erase(chart.rows.begin(), chart.rows.begin() + static_cast<std::ptrdiff_t>(rows));
  chart.rows.insert(chart.rows.begin(), std::move(gap));
  const auto place = [rows](std::size_t row) { return row < rows ? 0 : row - rows + 1; };
  for (Chart::Packet& packet : chart.packets) {
    std::erase_if(packet.blocks, [&](const Chart::Block& block) {
      return block.finished && block.last_row < rows;
    });
    for (Chart::Block& block : packet.blocks) {
      block.first_row = place(block.first_row);
      block.last_row = place(block.last_row);
    }
  }
}

}  // namespace stormproof::sequence
