// The test vectors of Cyclone DDS whose participants have a life: when discovery was complete for
// the last time, and what had been sent by then. Implementations that were written apart agree on
// them exactly.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/scenario.hpp"

namespace stormproof::vectors {

struct LifeExpected {
  std::optional<std::int64_t> t_disc_ns;  ///< nothing: never
  std::optional<std::int64_t> recovery_ns;
  std::int64_t forgotten = 0;  ///< by a lease
  std::int64_t initial_data = 0;
  std::int64_t repair_data = 0;
  std::int64_t heartbeat = 0;
  std::int64_t acknack = 0;
  std::int64_t gap = 0;
  std::int64_t spdp_multicast = 0;
  std::int64_t spdp_unicast = 0;
  std::int64_t user_control = 0;
  std::optional<std::int64_t> since_last_failure = {};  ///< of those that recover

  bool operator==(const LifeExpected&) const = default;
};

struct LifeVector {
  const char* name;
  model::Scenario scenario;
  LifeExpected expected;
};

[[nodiscard]] const std::vector<LifeVector>& cyclone_life_vectors();

/// Two participants on two hosts that start 108 ms apart, on the channel of the vectors.
[[nodiscard]] model::Scenario two_lives(model::AllowMulticast multicast);
/// The same over unicast, with so many ports of each host as peers.
[[nodiscard]] model::Scenario two_peers(std::uint32_t ports);
/// As Cyclone DDS 11.0 treats addresses at which nobody is known.
[[nodiscard]] model::Scenario pruning(model::Scenario scenario);

}  // namespace stormproof::vectors
