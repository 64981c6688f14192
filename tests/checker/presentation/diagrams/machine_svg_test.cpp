// The SVG diagrams of all machines: complete, and readable.
#include <algorithm>

#include <gtest/gtest.h>

#include "checker/presentation/diagrams/draw_machine.hpp"
#include "checker/presentation/diagrams/machine_layout.hpp"
#include "fsm/machines.hpp"
#include "tests/checker/presentation/diagrams/svg_texts.hpp"

namespace stormproof::draw {
namespace machine_svg_test {

class MachineSvg : public testing::TestWithParam<fsm::MachineInfo> {};

TEST_P(MachineSvg, HasEveryStateAndEveryRow) {
  const auto svg = read_svg(draw_machine(GetParam(), Format::svg));
  ASSERT_TRUE(svg);
  for (const std::string_view state : GetParam().states) {
    EXPECT_EQ(svg->count(std::string{state}), 1U) << state;
  }
  const std::string said = svg->joined("own") + " " + svg->joined("label");
  for (const fsm::RowInfo& row : GetParam().rows) {
    EXPECT_NE(said.find(row_text(GetParam(), row)), std::string::npos)
        << row_text(GetParam(), row) << " is not in " << said;
  }
}

TEST_P(MachineSvg, TextsDoNotOverlap) {
  EXPECT_EQ(read_svg(draw_machine(GetParam(), Format::svg))->fault(), "");
}

TEST_P(MachineSvg, EveryChangeOfStateIsAnEdgeBetweenItsStates) {
  const MachineLayout layout = layout_of(GetParam());
  for (const fsm::RowInfo& row : GetParam().rows) {
    if (row.source == row.target) continue;
    const auto is_its_edge = [&](const MachineLayout::Edge& edge) {
      const bool from = std::ranges::any_of(edge.sources, [&](const MachineLayout::Port& port) {
        return layout.states[port.state].name == GetParam().states[row.source];
      });
      return from && layout.states[edge.target.state].name == GetParam().states[row.target];
    };
    EXPECT_EQ(std::ranges::count_if(layout.edges, is_its_edge), 1)
        << row_text(GetParam(), row) << " from " << GetParam().states[row.source];
  }
}

TEST_P(MachineSvg, EdgesEndBesideTheirStates) {
  const MachineLayout layout = layout_of(GetParam());
  for (const MachineLayout::Edge& edge : layout.edges) {
    if (edge.side == MachineLayout::Edge::Side::straight) continue;
    auto ports = edge.sources;
    ports.push_back(edge.target);
    for (const MachineLayout::Port& port : ports) {
      const MachineLayout::State& state = layout.states[port.state];
      EXPECT_GT(port.y, state.y);
      EXPECT_LT(port.y, state.y + state.height);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, MachineSvg, testing::ValuesIn(fsm::machines()),
                         [](const auto& chosen) { return std::string{chosen.param.name}; });

TEST(MachineLayout, TheInitialStateIsFirstAndTheRepairCycleGoesDown) {
  const auto machines = fsm::machines();
  const auto repair = std::ranges::find(machines, "DescriptorRepair", &fsm::MachineInfo::name);
  const MachineLayout layout = layout_of(*repair);
  std::string order;
  for (const MachineLayout::State& state : layout.states) order += state.name;
  EXPECT_EQ(order, "URQSA");
  // The four acknowledgments share one track.
  const auto shared = std::ranges::find_if(
      layout.edges, [](const MachineLayout::Edge& edge) { return edge.sources.size() > 1; });
  ASSERT_NE(shared, layout.edges.end());
  EXPECT_EQ(shared->sources.size(), 4U);
  EXPECT_EQ(layout.states[shared->target.state].name, "A");
}

}  // namespace machine_svg_test
}  // namespace stormproof::draw
