// Draws what the layout has placed.
#include "checker/presentation/diagrams/machine_svg.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "checker/presentation/diagrams/machine_layout.hpp"
#include "checker/presentation/diagrams/svg.hpp"

namespace stormproof::draw {

namespace {

using Edge = MachineLayout::Edge;
using Side = Edge::Side;

constexpr std::string_view style = R"(
    .state { fill: var(--panel); stroke: var(--ink); stroke-width: 1.5; }
    .rule { stroke: var(--rule); }
    .edge { fill: none; stroke: var(--quiet); stroke-width: 1.5; }
    .into { marker-end: url(#arrow-ink); }
    .initial { fill: var(--ink); }
    .own { fill: var(--change); }
    .label { fill: var(--packet); paint-order: stroke; stroke: var(--paper); stroke-width: 4px;
             stroke-linejoin: round; }
)";

class Painter {
 public:
  explicit Painter(const fsm::MachineInfo& machine)
      : machine_{machine},
        layout_{layout_of(machine)},
        svg_{machine.name, "State machine; each edge says event [guard] / action."} {}

  std::string run() && {
    svg_.text(MachineLayout::margin, 34, machine_.name, "title");
    draw_initial();
    for (const Edge& edge : layout_.edges) {
      if (edge.side == Side::straight)
        draw_straight(edge);
      else
        draw_track(edge);
    }
    for (const MachineLayout::State& state : layout_.states) draw_state(state);
    for (const Edge& edge : layout_.edges) draw_label(edge);
    return svg_.finish(layout_.width, layout_.height, style);
  }

 private:
  [[nodiscard]] int middle() const { return layout_.left + layout_.box_width / 2; }

  void draw_initial() {
    const int top = layout_.states.front().y;
    svg_.circle(middle(), top - 28, 6, "initial");
    svg_.line(middle(), top - 22, middle(), top, "edge into");
  }

  void draw_state(const MachineLayout::State& state) {
    svg_.rect(layout_.left, state.y, layout_.box_width, state.height, "state", 10);
    const int words = state.words.empty() ? 0 : MachineLayout::line_height;
    int y = state.own_rows.empty() ? state.y + (state.height - words) / 2 + 5 : state.y + 22;
    svg_.text(middle(), y, state.name, "bold", Anchor::middle);
    if (words > 0) svg_.text(middle(), y + words, state.words, "quiet", Anchor::middle);
    if (state.own_rows.empty()) return;
    y += words + 12;
    svg_.line(layout_.left, y, layout_.left + layout_.box_width, y, "rule");
    y += MachineLayout::line_height;
    for (const std::string& line : state.own_rows) {
      svg_.text(layout_.left + 12, y, line, "own");
      y += MachineLayout::line_height;
    }
  }

  void draw_straight(const Edge& edge) {
    const MachineLayout::State& from = layout_.states[edge.sources.front().state];
    svg_.line(edge.x, from.y + from.height, edge.x, layout_.states[edge.target.state].y,
              "edge into");
  }

  void draw_track(const Edge& edge) {
    const bool right = edge.side == Side::right;
    const int side = right ? layout_.left + layout_.box_width : layout_.left;
    const int bend = right ? -8 : 8;
    for (const MachineLayout::Port& source : edge.sources) {
      const int turn = source.y < edge.target.y ? 8 : -8;
      svg_.path(
          fmt::format("M{} {} H{} Q{} {} {} {} V{} Q{} {} {} {} H{}", side, source.y, edge.x + bend,
                      edge.x, source.y, edge.x, source.y + turn, edge.target.y - turn, edge.x,
                      edge.target.y, edge.x + bend, edge.target.y, side),
          "edge into");
    }
  }

  void draw_label(const Edge& edge) {
    int y = edge.label_y;
    for (const std::string& line : edge.label) {
      if (edge.side == Side::left)
        svg_.text(edge.x - 12, y, line, "label", Anchor::end);
      else
        svg_.text(edge.x + 12, y, line, "label");
      y += MachineLayout::line_height;
    }
  }

  const fsm::MachineInfo& machine_;
  const MachineLayout layout_;
  Svg svg_;
};

}  // namespace

std::string machine_svg(const fsm::MachineInfo& machine) { return Painter{machine}.run(); }

}  // namespace stormproof::draw
