// The test vectors of what later versions of Fast DDS have, in the form of those of 2.6.11:
// profiles of 2.14.5 with one key changed, the whole of 3.2.5 and 3.6.2, and lookups of types that
// participants do not know.
#pragma once

#include <vector>

#include "tests/vectors/paper_vectors.hpp"

namespace stormproof::vectors {

[[nodiscard]] const std::vector<Vector>& version_vectors();

}  // namespace stormproof::vectors
