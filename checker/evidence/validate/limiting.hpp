// What a run waited for most: the air, a sender's buffer, or a participant's thread. It says which
// part of the model decides a prediction, so that a prediction that is off can be mended there.
#pragma once

#include <cstdint>
#include <vector>

#include "model/run_result.hpp"

namespace stormproof::validate {

/// Shares of a run's time up to its end, each 0 … 1.
struct Shares {
  double air = 0;        ///< the busiest channel was busy
  double sender = 0;     ///< the participant that stalled longest stalled
  double processor = 0;  ///< something waited for the thread that kept things waiting longest
};
[[nodiscard]] Shares shares_of(const model::RunResult& run);

/// What limits runs: the greatest share if it is at least one half; nothing then if the shares are
/// smaller: the run waits for start times and timers.
enum class Limit : std::uint8_t { none, air, sender, processor };
[[nodiscard]] const char* name_of(Limit limit);

/// The medians of the runs' shares, and what they say.
struct Limiting {
  Shares median{};
  Limit limit = Limit::none;
};
[[nodiscard]] Limiting limiting(const std::vector<Shares>& runs);

}  // namespace stormproof::validate
