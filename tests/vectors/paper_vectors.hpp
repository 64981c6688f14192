// The test vectors of the model: scenarios whose completion time and message counts are known
// exactly, because implementations that were written apart agree on them. One table, so that every
// simulator of the project is held to the same numbers.
#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "model/scenario.hpp"

namespace stormproof::vectors {

/// What a complete run reports. A simulator's test fills one in and compares.
struct Expected {
  std::int64_t t_disc_ns = 0;
  std::int64_t initial_data = 0;
  std::int64_t repair_data = 0;
  std::int64_t heartbeat = 0;
  std::int64_t acknack = 0;
  std::int64_t spdp_multicast = 0;
  std::int64_t spdp_unicast = 0;

  bool operator==(const Expected&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Expected& expected);

struct Vector {
  std::string name;  ///< letters, digits and underscores only: usable as the name of a test
  model::Scenario scenario;
  Expected expected;
  std::int64_t user_control = 0;
  std::int64_t lookup = 0;
};

/// Tests show a vector by its name.
inline std::ostream& operator<<(std::ostream& out, const Vector& vector) {
  return out << vector.name;
}

struct OpenLoopVector {
  std::string name;
  model::Scenario scenario;
  std::int64_t airtime_ns = 0;
};

inline std::ostream& operator<<(std::ostream& out, const OpenLoopVector& vector) {
  return out << vector.name;
}

/// The closed-loop vectors.
[[nodiscard]] const std::vector<Vector>& paper_vectors();

/// The open-loop vectors.
[[nodiscard]] const std::vector<OpenLoopVector>& open_loop_vectors();

}  // namespace stormproof::vectors
