// Tries a law on random scenarios, with RapidCheck, and shrinks what breaks it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "props/laws/law.hpp"

namespace stormproof::props {

struct Effort {
  int scenarios = 100;  ///< that the law applies to
  bool shrink = true;
  std::optional<model::ImplementationKind> implementation = {};  ///< absent: any engines know
};

/// The laws that say something about scenarios of the implementation: more than 5 of 100.
[[nodiscard]] std::vector<Law> laws_of(model::ImplementationKind implementation);

/// What breaks the law with the smallest scenario found, as text, or nothing. The scenarios are the
/// same on every machine.
[[nodiscard]] std::optional<std::string> broken_on_random_scenarios(const Law& law,
                                                                    const Simulate& simulate,
                                                                    const Effort& effort = {});

/// The simulator as it is.
[[nodiscard]] model::RunResult correct(const model::Scenario& scenario, model::Probe* probe);

}  // namespace stormproof::props
