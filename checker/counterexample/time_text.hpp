// Times in stories and charts. They are exact: a nanosecond decides who overtakes whom.
#pragma once

#include <string>

#include "model/units.hpp"

namespace stormproof::counterexample {

/// Exact, in milliseconds: "13.653072".
[[nodiscard]] std::string milliseconds(model::Nanoseconds time);
/// Exact, in the largest unit that leaves a whole part: "10 µs", "16.136228 ms".
[[nodiscard]] std::string exact_time(model::Nanoseconds time);

}  // namespace stormproof::counterexample
