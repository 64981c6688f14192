// Bytes of a packet and how numbers are read from them: every access is checked against the length
// that is really there, whatever a length field claims.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace stormproof::capture {

using Bytes = std::span<const std::uint8_t>;

enum class ByteOrder : std::uint8_t { big, little };

/// The part of `bytes` from `offset` on, at most `length` long; empty if there is none.
[[nodiscard]] inline Bytes part(Bytes bytes, std::size_t offset,
                                std::size_t length = std::dynamic_extent) {
  if (offset >= bytes.size()) return {};
  const std::size_t rest = bytes.size() - offset;
  return bytes.subspan(offset, length < rest ? length : rest);
}

/// Reads numbers one after the other. After a read beyond the end, every value is 0 and `failed`.
class Cursor {
 public:
  explicit Cursor(Bytes bytes, ByteOrder order = ByteOrder::big) : bytes_{bytes}, order_{order} {}

  [[nodiscard]] bool failed() const { return failed_; }
  [[nodiscard]] std::size_t position() const { return position_; }
  [[nodiscard]] Bytes rest() const { return failed_ ? Bytes{} : part(bytes_, position_); }

  std::uint8_t u8() { return static_cast<std::uint8_t>(number(1)); }
  std::uint16_t u16() { return static_cast<std::uint16_t>(number(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(number(4)); }
  /// A sequence number of RTPS: signed high half, then unsigned low half.
  std::int64_t sequence_number() {
    const std::uint64_t high = number(4);
    return static_cast<std::int64_t>(high << 32U | number(4));
  }
  /// The next `length` bytes; empty on failure.
  Bytes take(std::size_t length) {
    if (failed_ || length > bytes_.size() - position_) {
      failed_ = true;
      return {};
    }
    const Bytes taken = bytes_.subspan(position_, length);
    position_ += length;
    return taken;
  }
  void skip(std::size_t length) { static_cast<void>(take(length)); }

 private:
  std::uint64_t number(std::size_t size) {
    std::uint64_t value = 0;
    const Bytes digits = take(size);
    for (std::size_t k = 0; k < digits.size(); ++k) {
      const std::size_t at = order_ == ByteOrder::big ? k : digits.size() - 1 - k;
      value = value << 8U | digits[at];
    }
    return value;
  }

  Bytes bytes_;
  ByteOrder order_;
  std::size_t position_ = 0;
  bool failed_ = false;
};

}  // namespace stormproof::capture
