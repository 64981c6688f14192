// The column of times in stories and charts: one unit, and exact, because a nanosecond decides who
// overtakes whom.
#pragma once

#include <string>

#include "model/units.hpp"

namespace stormproof::report {

/// Exact, in milliseconds: "13.653072".
[[nodiscard]] std::string milliseconds(model::Nanoseconds time);

}  // namespace stormproof::report
