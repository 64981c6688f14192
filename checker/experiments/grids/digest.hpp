// Digests of inputs: whoever resumes a sweep has to know which jobs are done, whatever the grid
// file, the order of the jobs and the spelling of the values look like now. SHA-1, as Boost has it:
// what is wanted is that different inputs differ, not that nobody can forge them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "model/dds_profile.hpp"
#include "model/deployment.hpp"
#include "model/wireless_profile.hpp"

namespace stormproof::grids {

using Digest = std::array<std::uint8_t, 20>;

[[nodiscard]] Digest digest_of(std::string_view text);

/// Forty hexadecimal digits.
[[nodiscard]] std::string hex(const Digest& digest);

/// Of all that a run depends on: places, endpoints and times of the participants and the loopback
/// delay, not the ranges that the times were drawn from.
[[nodiscard]] Digest digest_of(const model::Deployment& deployment);

/// Of every value that the profile has in the end, after `base` and overrides.
[[nodiscard]] Digest digest_of(const model::DdsProfile& dds);
[[nodiscard]] Digest digest_of(const model::WirelessProfile& wireless);

}  // namespace stormproof::grids
