// Fragments and airtimes: what both oracles, the paper's and the one of `implementation: fastdds`,
// ask of the wireless profile. They are apart because they need no state at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/wireless_profile.hpp"

namespace stormproof::oracle {

/// The bytes that each fragment of a packet occupies the channel with.
[[nodiscard]] std::vector<std::int64_t> cut_into_fragments(const model::WirelessProfile& wireless,
                                                           std::int64_t payload);

enum class Rounding { to_nearest, down };

/// Nanoseconds that a fragment of `bytes` takes in a stage.
[[nodiscard]] std::int64_t airtime(const model::WirelessProfile& wireless, std::size_t stage,
                                   bool multicast, std::int64_t bytes,
                                   Rounding rounding = Rounding::to_nearest);

[[nodiscard]] std::int64_t ceil_div(std::int64_t a, std::int64_t b);

}  // namespace stormproof::oracle
