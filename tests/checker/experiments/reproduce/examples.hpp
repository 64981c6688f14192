// The shipped published figures, a small grid, and results that nobody simulated, so that every
// statistic can be checked by hand.
#pragma once

#include <string>

#include "checker/experiments/reproduce/reproduce_report.hpp"

namespace stormproof::reproduce {

/// Text of a file in specs/published.
[[nodiscard]] std::string shipped(const std::string& name);
/// The shipped figures as they are.
[[nodiscard]] Published shipped_figures();
/// The shipped figures with this grid instead of the 90 configurations.
[[nodiscard]] Published figures_with_grid(const std::string& participants,
                                          const std::string& endpoints);
[[nodiscard]] Plan plan_of(const Published& published, const PlanOptions& options = {});

/// A run that took `seconds`, with these counts.
[[nodiscard]] Run finished_run(double seconds, const model::Counts& counts);

/// Results of all cases, made up: completion N_P·N_E ms on Wi-Fi and 1 ms elsewhere, half of it
/// with the adaptive policy, 1 % and 3 % less with the second and third order of service; a total
/// of 10·N_P messages on Wi-Fi and 5·N_P elsewhere.
[[nodiscard]] Results made_up(const Plan& plan);

[[nodiscard]] Report report_of(const Published& published, Results results);

}  // namespace stormproof::reproduce
