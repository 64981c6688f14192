// Compressed captures, for tests.
#pragma once

#include "tests/checker/evidence/capture/packets.hpp"

namespace stormproof::capture::testing {

/// `plain` as a .gz file.
[[nodiscard]] Buffer gzip(const Buffer& plain);

}  // namespace stormproof::capture::testing
