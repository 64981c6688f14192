// What was held against live runs of each way to discover, and how far: the numbers of
// specs/observations/validated.yaml, which `stormproof coverage` gives again.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "model/config/tree/result.hpp"

namespace stormproof::compare {

/// How a prediction lay to what was measured, over configurations.
struct Nearness {
  double ratio = 0;      ///< median of model over measurement
  double deviation = 0;  ///< median of |ln ratio|
};

struct Measured {
  std::string what;     ///< "Cyclone DDS 0.10.2, 48 runs on the emulated access point"
  std::string command;  ///< gives the numbers again
  std::size_t configurations = 0;
  Nearness completion, messages;
};

using Validated = std::map<std::string, Measured, std::less<>>;

/// Of the first of these folders that has the file; nothing if none has. Errors with their place.
[[nodiscard]] model::config::Result<Validated> read_validated(
    const std::vector<std::string>& directories);

}  // namespace stormproof::compare
