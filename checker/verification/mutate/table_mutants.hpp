// The part of the mutant catalogue that concerns transition tables.
#pragma once

#include "checker/verification/mutate/mutants.hpp"

namespace stormproof::mutate {

[[nodiscard]] std::vector<CatalogueEntry> table_mutants();

}  // namespace stormproof::mutate
