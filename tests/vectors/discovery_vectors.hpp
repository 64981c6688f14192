// The test vectors of `discovery: server`, `super_client` and `static`, in the same form as the
// others: implementations that were written apart agree on them exactly.
#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "model/scenario.hpp"

namespace stormproof::vectors {

/// What a run has to yield: the counts are those of cross-host messages.
struct DiscoveryExpected {
  std::int64_t t_disc_ns = 0;
  std::int64_t initial_data = 0;
  std::int64_t repair_data = 0;
  std::int64_t heartbeat = 0;
  std::int64_t acknack = 0;
  std::int64_t announcements = 0;  ///< DATA(p); with static peers SPDP by unicast
  std::int64_t pdp_heartbeat = 0;
  std::int64_t pdp_acknack = 0;
  std::int64_t gap = 0;
  std::int64_t user_control = 0;

  bool operator==(const DiscoveryExpected&) const = default;
};
std::ostream& operator<<(std::ostream& out, const DiscoveryExpected& expected);

struct DiscoveryVector {
  std::string name;  ///< letters, digits and underscores only: usable as the name of a test
  model::Scenario scenario;
  DiscoveryExpected expected;
};

inline std::ostream& operator<<(std::ostream& out, const DiscoveryVector& vector) {
  return out << vector.name;
}

[[nodiscard]] const std::vector<DiscoveryVector>& discovery_vectors();

}  // namespace stormproof::vectors
