// How reports write figures of many runs, such as medians: as counts and times to the nearest unit.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "checker/presentation/text/numbers.hpp"

namespace stormproof::report {

/// A time in ns.
[[nodiscard]] inline std::string time_figure(double ns) {
  return duration(model::Nanoseconds{static_cast<std::int64_t>(std::llround(ns))});
}
/// The same; `absent` if there is none, because runs did not complete.
[[nodiscard]] inline std::string time_figure(const std::optional<double>& ns, const char* absent) {
  return ns ? time_figure(*ns) : absent;
}

/// A number of things, at least 0.
[[nodiscard]] inline std::string count_figure(double count) {
  return grouped(static_cast<std::uint64_t>(std::llround(count)));
}
[[nodiscard]] inline std::string count_figure(const std::optional<double>& count) {
  return count ? count_figure(*count) : "–";
}

}  // namespace stormproof::report
