// Where the states and edges of a machine stand in its diagram. States form one column, from the
// initial one down, in the order that leaves the fewest and shortest detours. An edge to the next
// state goes straight down; other edges run along tracks, those that lead down on the right and
// those that lead up on the left. Edges with the same label into the same state share a track. A
// state lists the rows that lead back to itself. Labels stand in the gaps between states, each
// track has a column of its own, and edges leave states only beside them, so nothing overlaps.
#pragma once

#include <string>
#include <vector>

#include "fsm/machine_info.hpp"

namespace stormproof::draw {

struct MachineLayout {
  static constexpr int margin = 24;
  static constexpr int line_height = 16;
  static constexpr int font_size = 12;

  struct State {
    std::string name;
    std::string words;                  ///< what a letter stands for; empty: the name says it
    std::vector<std::string> own_rows;  ///< rows that lead back, broken into lines
    int y = 0;
    int height = 0;
  };

  struct Port {
    std::size_t state = 0;  ///< position in the column
    int y = 0;
  };

  struct Edge {
    enum class Side : std::uint8_t { straight, right, left };
    Side side{};
    std::vector<Port> sources;
    Port target;
    std::vector<std::string> label;  ///< lines
    int x = 0;                       ///< of the vertical part
    int label_y = 0;                 ///< baseline of the first line
    std::size_t gap = 0;             ///< the label is between states `gap` and `gap` + 1
  };

  std::vector<State> states;  ///< from top to bottom; the first is the initial one
  std::vector<Edge> edges;
  int left = 0;  ///< of the states
  int box_width = 0;
  int width = 0;
  int height = 0;
};

[[nodiscard]] MachineLayout layout_of(const fsm::MachineInfo& machine);

}  // namespace stormproof::draw
