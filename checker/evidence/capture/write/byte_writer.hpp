// Bytes of a packet under construction: appends numbers in one byte order, the opposite of Cursor.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "checker/evidence/capture/bytes.hpp"
#include "checker/evidence/capture/identifiers.hpp"

namespace stormproof::capture::write {

using Buffer = std::vector<std::uint8_t>;

class ByteWriter {
 public:
  explicit ByteWriter(ByteOrder order = ByteOrder::little) : order_{order} {}

  /// Each takes the low bytes of `value`.
  ByteWriter& u8(std::uint64_t value) { return number(value, 1); }
  ByteWriter& u16(std::uint64_t value) { return number(value, 2); }
  ByteWriter& u32(std::uint64_t value) { return number(value, 4); }
  /// A sequence number of RTPS: high half, then low half.
  ByteWriter& sequence_number(std::uint64_t value) { return u32(value >> 32U).u32(value); }
  /// An entity id: four octets, which have no byte order.
  ByteWriter& entity(EntityId value) {
    for (unsigned shift = 32; shift > 0; shift -= 8) u8(value >> (shift - 8));
    return *this;
  }
  ByteWriter& bytes(Bytes more) {
    buffer_.insert(buffer_.end(), more.begin(), more.end());
    return *this;
  }
  ByteWriter& zeros(std::size_t count) {
    buffer_.insert(buffer_.end(), count, 0);
    return *this;
  }
  /// A CDR string with its length and terminator, filled up to a multiple of four.
  ByteWriter& text(std::string_view text) {
    u32(text.size() + 1);
    buffer_.insert(buffer_.end(), text.begin(), text.end());
    return zeros(4 - text.size() % 4);
  }

  [[nodiscard]] std::size_t size() const { return buffer_.size(); }
  [[nodiscard]] const Buffer& buffer() const { return buffer_; }
  [[nodiscard]] Buffer take() && { return std::move(buffer_); }

 private:
  ByteWriter& number(std::uint64_t value, unsigned size) {
    for (unsigned k = 0; k < size; ++k) {
      const unsigned place = order_ == ByteOrder::little ? k : size - 1 - k;
      buffer_.push_back(static_cast<std::uint8_t>(value >> (8 * place)));
    }
    return *this;
  }

  ByteOrder order_;
  Buffer buffer_;
};

}  // namespace stormproof::capture::write
