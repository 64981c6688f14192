// The plots of the report, in the shape of the paper's figures.
#pragma once

#include <string>

#include "checker/experiments/reproduce/reproduce_report.hpp"

namespace stormproof::reproduce {

/// Counts by class at N_P 5, N_E 20, published and of all variants, on one network.
[[nodiscard]] std::string counts_plot(const Report& report, Network network);
/// Wi-Fi / wired total messages over the grid, from above.
[[nodiscard]] std::string surface_plot(const Report& report, std::size_t variant);
/// One class over the workload in the three environments, with the failure-free reference.
[[nodiscard]] std::string environments_plot(const Report& report, std::size_t variant, Class what);
/// Completion over the workload: all variants, open loop, published means.
[[nodiscard]] std::string completion_plot(const Report& report);
/// The same of total messages, with the failure-free reference.
[[nodiscard]] std::string messages_plot(const Report& report);
/// Model / observed mean by N_P; `quantity` is "completion_s" or "messages".
[[nodiscard]] std::string ratio_plot(const Report& report, const std::string& quantity);
/// Completion with the periodic and the adaptive policy, and the published means of both.
[[nodiscard]] std::string policies_plot(const Report& report, std::size_t variant);
/// Completion-time spread over the orders of service.
[[nodiscard]] std::string spreads_plot(const Report& report);

}  // namespace stormproof::reproduce
