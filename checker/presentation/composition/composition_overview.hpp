// The first picture of a composition's drawing: who there is on which side, and which packets go
// from one side to the other.
#pragma once

#include <vector>

#include "checker/presentation/composition/composition_graph.hpp"
#include "checker/presentation/composition/composition_pen.hpp"

namespace stormproof::draw {

/// Draws it from `top` on; returns where it ends.
int draw_overview(const fsm::composition::CompositionInfo& composition,
                  const std::vector<Party>& parties, CompositionPen& pen, Svg& svg, int top);

}  // namespace stormproof::draw
