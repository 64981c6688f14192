// The catalogue of mutants: plausible mistakes in the transition tables, in the rules around them,
// in the order of events and in the profile that runs. `stormproof mutate` looks which property
// notices which.
#pragma once

#include <string>
#include <vector>

#include "checker/engines/bounds/check_request.hpp"

namespace stormproof::mutate {

/// Which runs a mutant can show itself in.
enum class Concerns : std::uint8_t { both, paper, fastdds };

struct CatalogueEntry {
  checker::Mutant mutant;
  Concerns concerns = Concerns::both;
  /// Why no property can notice it, if that is known; empty otherwise.
  std::string survives_because;
};

/// All mutants; ids are stable and unique.
[[nodiscard]] std::vector<CatalogueEntry> mutants();

}  // namespace stormproof::mutate
