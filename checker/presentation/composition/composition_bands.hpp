// A rule in the drawing of a composition: at its left stands what triggers it, in the middle its
// effects with their numbers, at the right what leaves: packets, timers, calls, each with a link to
// the rule that handles it.
#pragma once

#include <string>
#include <vector>

#include "checker/presentation/composition/composition_graph.hpp"
#include "checker/presentation/composition/composition_pen.hpp"

namespace stormproof::draw {

/// Draws it from `y` on, or where the next printed page begins; returns where it ends.
int draw_band(const fsm::composition::CompositionInfo& composition,
              const std::vector<Party>& parties, const fsm::composition::RuleInfo& rule,
              CompositionPen& pen, Svg& svg, int y);

/// What the drawing's style sheet needs for it, beside that of the pen.
[[nodiscard]] std::string band_style();

}  // namespace stormproof::draw
