// The test vectors of `implementation: fastdds`, in the same form as those of the paper's model:
// implementations that were written apart agree on them exactly.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/scenario.hpp"
#include "tests/vectors/paper_vectors.hpp"

namespace stormproof::vectors {

struct FastddsVector {
  std::string name;  ///< letters, digits and underscores only: usable as the name of a test
  model::Scenario scenario;
  Expected expected;
  std::int64_t user_control = 0;
};

inline std::ostream& operator<<(std::ostream& out, const FastddsVector& vector) {
  return out << vector.name;
}

[[nodiscard]] const std::vector<FastddsVector>& fastdds_vectors();

}  // namespace stormproof::vectors
