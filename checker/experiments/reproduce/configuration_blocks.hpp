// The single configurations behind the figures.
#pragma once

#include "checker/experiments/reproduce/reproduce_report.hpp"

namespace stormproof::reproduce {

/// At a terminal three grids of the first variant, in documents a table of each, folded.
void add_configurations(report::Blocks& blocks, const Report& report);

}  // namespace stormproof::reproduce
