// `stormproof mutate`: which property notices which mistake.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace stormproof::cli {

struct MutateArguments {
  std::vector<std::string> only;  ///< ids of mutants; empty: all
  bool json = false;
  double timeout_seconds = 10;   ///< of each query
  std::optional<bool> progress;  ///< not given: when stderr is a terminal
};

/// Exit code: established if at least 95 % of the mutants are noticed, violated if fewer are,
/// inconclusive if interrupted.
[[nodiscard]] int mutate(const MutateArguments& arguments);

}  // namespace stormproof::cli
