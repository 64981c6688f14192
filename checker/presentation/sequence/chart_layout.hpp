// Where everything of a sequence chart stands, in pixels. Texts never overlap, by construction:
// each participant has a column for its texts as wide as the widest of them, on the side of its
// lane that is turned away from the channels, and each row is as high as its longest column.
#pragma once

#include <string>
#include <vector>

#include "checker/presentation/sequence/chart.hpp"

namespace stormproof::sequence {

struct ChartLayout {
  static constexpr int margin = 24;
  static constexpr int line_height = 16;
  static constexpr int font_size = 12;

  struct Lane {
    int x = 0;               ///< of the line of a participant, of the middle of a channel
    int left = 0;            ///< of the whole column
    int width = 0;           ///< of the whole column
    bool text_left = false;  ///< texts end at the lane instead of beginning there
    int blocks_left = 0;     ///< channels: where blocks begin
    int block_width = 0;
    int notes_left = 0;  ///< channels: where texts begin
  };

  /// A text of a row, broken.
  struct Text {
    std::size_t line = 0;  ///< in `Chart::Row::lines`
    int y = 0;             ///< baseline of the first line
    std::vector<std::string> parts;
  };

  struct Row {
    int y = 0;
    int height = 0;
    std::vector<Text> texts;
    std::vector<std::string> gap;  ///< lines of a gap's text, left of the channels
  };

  struct Block {
    std::size_t block = 0;  ///< in `Chart::Packet::blocks`
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
  };

  int time_width = 0;               ///< of the column with events and times
  int top = 0;                      ///< of the first row
  int bottom = 0;                   ///< of the last row
  int width = 0;                    ///< of the drawing
  std::vector<std::string> header;  ///< lines above the lanes
  std::vector<Lane> lanes;
  std::vector<Row> rows;
  std::vector<std::vector<Block>> blocks;  ///< by packet, without those there is no room for
};

[[nodiscard]] ChartLayout layout_of(const Chart& chart);

/// What a block says: "p14 uplink".
[[nodiscard]] std::string block_text(const Chart::Packet& packet, const Chart::Block& block);

}  // namespace stormproof::sequence
