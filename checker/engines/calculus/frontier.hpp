// How much a deployment can be loaded so that storm.cannot-start is still proved: the largest
// number of endpoints, of participants on each host, and of hosts, each alone. What is more loaded
// has more open-loop traffic and no longer threshold, so the proved ones come before all others.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "model/scenario.hpp"

namespace stormproof::calculus {

struct Frontier {
  const char* load = "";                   ///< "user endpoints of each participant"
  std::optional<std::uint32_t> now = {};   ///< in the scenario; absent if they are not all alike
  std::optional<std::uint32_t> most = {};  ///< for which it is proved; absent: not for the least
  std::uint32_t least = 0;                 ///< that was tried
  std::uint32_t limit = 0;  ///< that was tried: if `most` is as large, more may be proved
  /// No packet takes longer at `most`; absent: no bound is needed.
  std::optional<model::Nanoseconds> delay = {};
};

struct Frontiers {
  std::string_view why_not = {};  ///< why storm.cannot-start does not apply; then there is no list
  /// Why nothing is proved of the scenario as it is, as a sentence; loads can differ.
  std::string_view why_not_provable = {};
  std::vector<Frontier> of_loads = {};
};

[[nodiscard]] Frontiers frontier_of(const model::Scenario& scenario);

}  // namespace stormproof::calculus
