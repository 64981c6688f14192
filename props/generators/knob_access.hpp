// The knobs of a scenario one by one, each as an integer with the value it should return to, so
// that shrinking can treat a timer, a choice and a start time alike. The knob tables of the reader
// say what there is; nothing is listed twice.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "model/scenario.hpp"

namespace stormproof::props {

/// One value of a scenario. `get` and `set` refer to the scenario that it was taken from.
struct Knob {
  /// What its rounding means: a duration (in ns), another amount, or nothing (choices, fractions).
  enum class Kind : std::uint8_t { duration, amount, choice };

  Kind kind{};
  bool may_be_zero = false;
  std::int64_t base = 0;  ///< the value to return to
  std::function<std::int64_t()> get;
  std::function<void(std::int64_t)> set;

  [[nodiscard]] bool is_changed() const { return get() != base; }
};

/// The knobs of both profiles that the scenario's implementation has, of its stages, packet delays
/// and start times, and its time limit; `base` says what they return to. Scenarios with lists of
/// equal lengths have the same knobs at the same places. Numbers of endpoints, lost packets and
/// hosts are no knobs.
[[nodiscard]] std::vector<Knob> knobs_of(model::Scenario& scenario, const model::Scenario& base);

}  // namespace stormproof::props
