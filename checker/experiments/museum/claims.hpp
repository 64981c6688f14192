// What exhibits of the museum of defects are held against: properties of the catalogue that a
// monitor decides whatever the rules are, and one more. A claim says nothing of its own about them.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "model/scenario.hpp"
#include "props/monitor.hpp"

namespace stormproof::museum {

struct Claim {
  std::string_view id;
  std::string_view statement;
  std::string_view formal;
  bool has_bound = false;  ///< an exhibit says the bound B
};

[[nodiscard]] const std::vector<Claim>& claims();
/// Null if there is none.
[[nodiscard]] const Claim* find_claim(std::string_view id);

/// The monitor of one of the `claims` for runs of the scenario.
[[nodiscard]] std::unique_ptr<props::Monitor> monitor_of(std::string_view claim,
                                                         const model::Scenario& scenario,
                                                         std::optional<model::Nanoseconds> bound);

/// Of storm.copy-per-loss.
[[nodiscard]] std::unique_ptr<props::Monitor> watch_copies();

}  // namespace stormproof::museum
