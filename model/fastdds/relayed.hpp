// What a packet of a Discovery Server carries, or an ACKNACK of a client asks for. Changes are
// numbered from 1, for each of the server's three writers.
#pragma once

#include <cstdint>
#include <vector>

#include "model/units.hpp"

namespace stormproof::model {

struct Relayed {
  bool has_data = false;
  bool is_announcement = false;  ///< DATA(p) of `participant`; otherwise a descriptor of it
  bool is_goodbye = false;       ///< that says that it is gone
  std::uint32_t participant = 0;
  Stream stream{};
  std::uint32_t descriptor = 0;
  std::int64_t number = 0;            ///< of the change that the DATA is
  std::vector<std::int64_t> numbers;  ///< of a GAP, or what an ACKNACK asks for; ascending
  bool has_heartbeat = false;
  std::int64_t first = 0;  ///< what the HEARTBEAT announces
  std::int64_t last = 0;
  std::int64_t count = 0;  ///< which HEARTBEAT of the relay it is, from 1 on
  std::int64_t base = 0;   ///< of an ACKNACK

  bool operator==(const Relayed&) const = default;
};

/// The server's writers, and how its relations are numbered: relation 3·pair + relay.
namespace fastdds::relay {
inline constexpr std::uint32_t announcements = 0;
inline constexpr std::uint32_t publications = 1;
inline constexpr std::uint32_t subscriptions = 2;
inline constexpr std::uint32_t count = 3;
}  // namespace fastdds::relay

}  // namespace stormproof::model
