// The test vectors of `implementation: cyclone`, in the same form as the others: implementations
// that were written apart agree on them exactly.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/scenario.hpp"
#include "tests/vectors/paper_vectors.hpp"

namespace stormproof::vectors {

struct CycloneVector {
  std::string name;  ///< letters, digits and underscores only: usable as the name of a test
  model::Scenario scenario;
  Expected expected;
  std::int64_t user_control = 0;
};

inline std::ostream& operator<<(std::ostream& out, const CycloneVector& vector) {
  return out << vector.name;
}

[[nodiscard]] const std::vector<CycloneVector>& cyclone_vectors();

/// Two hosts with participants that start one after the other, on the channel of the vectors.
[[nodiscard]] model::Scenario cyclone_grid(std::uint32_t participants_per_host,
                                           std::uint32_t endpoints,
                                           model::AllowMulticast multicast);

}  // namespace stormproof::vectors
