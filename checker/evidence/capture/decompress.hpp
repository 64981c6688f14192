// Captures are kept compressed: .xz and .gz are unpacked while they are read, up to a bound,
// because a few bytes can unpack to any number of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "checker/evidence/capture/bytes.hpp"
#include "model/config/tree/result.hpp"

namespace stormproof::capture {

enum class Compression : std::uint8_t { none, xz, gzip };

/// From the first bytes of a file (6 are enough).
[[nodiscard]] Compression compression_of(Bytes start);

/// The next of the packed bytes, which are valid until it is asked again; none at their end.
using Packed = std::function<Bytes()>;

class Decoder;

/// All streams in what is packed, one after the other, piece by piece: memory does not follow the
/// size of a capture.
class Unpacking {
 public:
  /// `kind` is no `none`; `limit` bounds what is unpacked, in bytes.
  Unpacking(Packed packed, Compression kind, std::uint64_t limit);
  ~Unpacking();
  Unpacking(const Unpacking&) = delete;
  Unpacking& operator=(const Unpacking&) = delete;

  /// How many bytes of `room` were filled; 0 at the end, and where the data is damaged.
  [[nodiscard]] std::size_t read(std::span<std::uint8_t> room);
  /// Why the data ends before its end mark, if it does: "the .xz data is cut off".
  [[nodiscard]] const std::string& damage() const { return damage_; }
  [[nodiscard]] bool is_too_long() const { return is_too_long_; }

 private:
  std::unique_ptr<Decoder> decoder_;
  std::uint64_t limit_;
  std::uint64_t unpacked_ = 0;
  std::string damage_;
  bool has_ended_ = false;
  bool is_too_long_ = false;
};

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
