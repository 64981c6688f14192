// How large a packet can get. Every fragment is an event of its own, so a packet of a gigabyte in
// fragments of a byte would keep a run busy for ever; the reader refuses such a scenario.
#pragma once

#include <string_view>

#include "model/airtime.hpp"
#include "model/scenario.hpp"

namespace stormproof::model::config {

/// Most fragments of a packet that are accepted.
inline constexpr std::int64_t max_fragments = 1'000'000;

struct LargestPacket {
  Bytes payload;            ///< UDP payload; no packet of the scenario has more
  std::string_view origin;  ///< the keys that it comes from, for an error message
};

[[nodiscard]] LargestPacket largest_packet(const Scenario& scenario);

}  // namespace stormproof::model::config
