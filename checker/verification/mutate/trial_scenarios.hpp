// The small scenarios on which mutants are tried: together they take every row of the tables that a
// run can take, and without a mutant they keep nearly every property.
#pragma once

#include <string>
#include <vector>

#include "model/scenario.hpp"

namespace stormproof::mutate {

struct Trial {
  std::string name;
  model::Scenario scenario;
  bool all_engines = false;  ///< also the explorer and the timelines, which only need the timers
};

[[nodiscard]] std::vector<Trial> trials(model::ImplementationKind implementation);

}  // namespace stormproof::mutate
