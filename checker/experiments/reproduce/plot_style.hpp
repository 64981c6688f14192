// What the plots of the reproduction have in common: sizes, colours, names.
#pragma once

#include <limits>
#include <set>
#include <string>

#include "checker/experiments/reproduce/reproduce_report.hpp"

namespace stormproof::reproduce {

inline constexpr double gap = std::numeric_limits<double>::quiet_NaN();
inline constexpr std::size_t published_color = 4;

/// A colour for each variant, apart from those of published values and references.
[[nodiscard]] inline std::size_t color_of(std::size_t variant) { return variant; }

[[nodiscard]] inline std::set<std::uint32_t> participant_counts(const Plan& plan) {
  std::set<std::uint32_t> counts;
  for (const Configuration& one : plan.configurations) counts.insert(one.participants_per_host);
  return counts;
}

[[nodiscard]] inline std::string variant_name(const Report& report, std::size_t variant) {
  return report.results.plan.variants[variant].id;
}

}  // namespace stormproof::reproduce
