// The steps of shrinking, as functions that change a scenario. They may go too far: simpler.cpp
// keeps those that leave the scenario valid and make it simpler.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "model/scenario.hpp"
#include "props/generators/complexity.hpp"

namespace stormproof::props {

/// Changes a scenario equal to the one that it was made for.
using Edit = std::function<void(model::Scenario&)>;
using Edits = std::vector<Edit>;

/// Most edits of one kind: a large scenario is shrunk in coarse steps first, and what is left is
/// small.
inline constexpr std::size_t most_edits = 2'000;

void add_deployment_edits(const model::Scenario& scenario, Edits& edits);
void add_packet_edits(const model::Scenario& scenario, const model::Scenario& base, Edits& edits);
void add_route_edits(const model::Scenario& scenario, const model::Scenario& base, Edits& edits);
/// Knobs back to the base.
void add_reset_edits(const model::Scenario& scenario, const model::Scenario& base, Edits& edits);
/// Knobs to rounder numbers.
void add_rounding_edits(const model::Scenario& scenario, const model::Scenario& base, Edits& edits);

/// All of them, boldest first.
[[nodiscard]] Edits simplifying_edits(const model::Scenario& scenario, const model::Scenario& base);

/// The edited scenario, if it is valid and simpler than `scenario`, whose complexity is given.
[[nodiscard]] std::optional<model::Scenario> edited(const Edit& edit,
                                                    const model::Scenario& scenario,
                                                    const model::Scenario& base,
                                                    const Complexity& of_scenario);

/// Calls `use(first, last)` for the parts of a list of `size`: all of it, halves, quarters, … and
/// single elements.
template <class Use>
void for_parts(std::size_t size, const Use& use) {
  std::size_t calls = 0;
  for (std::size_t part = size; part > 0; part /= 2) {
    for (std::size_t first = 0; first < size; first += part) {
      if (++calls > most_edits) return;
      use(first, std::min(first + part, size));
    }
  }
}

}  // namespace stormproof::props
