// The load up to which storm.cannot-start is proved, as a table.
#pragma once

#include "checker/engines/calculus/frontier.hpp"
#include "checker/presentation/document/document.hpp"

namespace stormproof::checker {

/// Nothing is added if there are none.
void add_frontiers(report::Document& document, const calculus::Frontiers& frontiers);

}  // namespace stormproof::checker
