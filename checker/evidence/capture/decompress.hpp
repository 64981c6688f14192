// Captures are kept compressed: .xz and .gz are unpacked into memory, up to a bound, because a few
// bytes can unpack to any number of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "checker/evidence/capture/bytes.hpp"
#include "model/config/tree/result.hpp"

namespace stormproof::capture {

enum class Compression : std::uint8_t { none, xz, gzip };

/// From the first bytes of a file (6 are enough).
[[nodiscard]] Compression compression_of(Bytes start);

struct Unpacked {
  std::vector<std::uint8_t> bytes{};
  /// Why the data ends before its end mark, if it does: "the .xz data is cut off". What was before
  /// is in `bytes`.
  std::string damage{};
};

/// All streams in `packed`, one after the other. Refused with the reason: more than `limit` bytes,
/// or nothing at all could be unpacked.
[[nodiscard]] model::config::Result<Unpacked, std::string> unpack(Bytes packed, Compression kind,
                                                                  std::size_t limit);

}  // namespace stormproof::capture
