// The test vectors of `implementation: fastdds`, in the same form as those of the paper's model:
// implementations that were written apart agree on them exactly.
#pragma once

#include <vector>

#include "tests/vectors/paper_vectors.hpp"

namespace stormproof::vectors {

[[nodiscard]] const std::vector<Vector>& fastdds_vectors();

}  // namespace stormproof::vectors
