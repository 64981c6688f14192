// How the writers of participants, and the relations of pairs, are numbered.
#pragma once

#include <cstdint>

namespace stormproof::model {

/// With `stride` writers of each participant, writer c of participant i has number i·stride + c,
/// and its relation on a pair pair·stride + c. Loops over streams are about the first `streams` of
/// them.
struct WriterLayout {
  std::uint32_t stride = 2;
  std::uint32_t streams = 2;
};

}  // namespace stormproof::model
