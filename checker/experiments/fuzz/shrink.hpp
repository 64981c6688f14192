// Makes a violating variant smaller and more like the scenario that it was drawn around.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "checker/experiments/fuzz/judged_run.hpp"

namespace stormproof::fuzz {

struct Shrunk {
  props::Counterexample counterexample;
  std::uint32_t tried = 0;     ///< scenarios that have run
  std::uint32_t accepted = 0;  ///< of them: those that were simpler and broke the same
  bool finished = false;       ///< nothing simpler breaks it; otherwise the effort was spent
};

/// Most events that shrinking one counterexample may take. A number of events and not a time, so
/// that the answer is the same on every machine.
inline constexpr std::uint64_t shrinking_events = 20'000'000;

/// Goes from `found` to simpler and simpler scenarios, each of which breaks the same property or
/// limit, until none of the simpler ones does or `most_events` are spent. `base` is what the
/// variant was drawn around.
[[nodiscard]] Shrunk shrink(props::Counterexample found, const model::Scenario& base,
                            std::uint64_t most_events, const GoesOn& goes_on);

/// How `scenario` differs from `base`, in lines: knobs, starts, losses, size.
[[nodiscard]] std::vector<std::string> differences(const model::Scenario& scenario,
                                                   const model::Scenario& base);

}  // namespace stormproof::fuzz
