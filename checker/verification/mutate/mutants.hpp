// The catalogue of mutants: plausible mistakes in the transition tables, in the rules around them,
// in the order of events and in the profile that runs. `stormproof mutate` looks which property
// notices which.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "checker/engines/bounds/check_request.hpp"
#include "checker/verification/mutate/concerns.hpp"

namespace stormproof::mutate {

/// Where the mistake is.
enum class Kind : std::uint8_t { table, event, snapshot, knob, order, effect };
inline constexpr std::array<std::string_view, 6> kind_names{"table", "event", "snapshot",
                                                            "knob",  "order", "effect"};
[[nodiscard]] constexpr std::string_view name_of(Kind kind) {
  return kind_names[static_cast<std::size_t>(kind)];
}

struct CatalogueEntry {
  checker::Mutant mutant;
  Concerns concerns = everywhere();  ///< in whose runs it can show itself
  /// Why no property can notice it, if that is known; empty otherwise.
  std::string survives_because;
  Kind kind = Kind::table;
};

/// All mutants; ids are unique, and stable as long as the rules stay as they are.
[[nodiscard]] std::vector<CatalogueEntry> mutants();

}  // namespace stormproof::mutate
