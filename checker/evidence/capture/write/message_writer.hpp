// An RTPS message under construction (RTPS 2.5, sections 8.3 and 9.4), little endian: the
// submessages that discovery needs, and padding to a given size, so that a packet is as large as
// the model says.
#pragma once

#include <cstdint>
#include <span>

#include "checker/evidence/capture/address.hpp"
#include "checker/evidence/capture/parameter_list.hpp"
#include "checker/evidence/capture/rtps_message.hpp"
#include "checker/evidence/capture/write/byte_writer.hpp"

namespace stormproof::capture::write {

[[nodiscard]] constexpr std::uint16_t id_of(ParameterId id) {
  return static_cast<std::uint16_t>(id);
}

/// A parameter list with its encapsulation, without its sentinel.
class ParameterWriter {
 public:
  ParameterWriter() { out_.u8(0).u8(parameter_list_little_endian).u16(0); }

  ParameterWriter& number(std::uint16_t id, std::uint64_t value);
  /// Octets, their number a multiple of four.
  ParameterWriter& octets(std::uint16_t id, Bytes value);
  ParameterWriter& text(std::uint16_t id, std::string_view text);
  ParameterWriter& guid(std::uint16_t id, const Guid& guid);
  /// A UDP locator of IPv4.
  ParameterWriter& locator(std::uint16_t id, const UdpEnd& end);

  [[nodiscard]] const Buffer& buffer() const { return out_.buffer(); }

 private:
  static constexpr std::uint8_t parameter_list_little_endian = 3;

  ByteWriter out_;
};

/// Asks for descriptor d, in ascending order. A bitmap reaches 256 numbers far; what is missing
/// beyond is not in it.
void ask(SequenceNumberSet& missing, std::uint32_t d);

/// The smallest DATA submessage with this parameter list, in bytes: a multiple of four.
[[nodiscard]] std::size_t smallest_data(const ParameterWriter& parameters);

class MessageWriter {
 public:
  static constexpr std::size_t header_size = 20;
  static constexpr std::size_t info_ts_size = 12;
  static constexpr std::size_t heartbeat_size = 32;

  MessageWriter(VendorId vendor, const GuidPrefix& source);

  void info_dst(const GuidPrefix& destination);
  /// `time_ns` ≥ 0, since 1970.
  void info_ts(std::int64_t time_ns);
  /// A submessage of `size` bytes if that is at least its smallest size, rounded down to a multiple
  /// of four; padded within its parameter list (PID_PAD).
  void data(EntityId reader, EntityId writer, std::uint64_t sequence_number,
            const ParameterWriter& parameters, std::size_t size);
  /// The same with a key alone: what it is about is gone.
  void disposal(EntityId reader, EntityId writer, std::uint64_t sequence_number,
                const ParameterWriter& key, std::size_t size);
  /// Not final: the reader has to answer.
  void heartbeat(EntityId reader, EntityId writer, std::uint64_t last, std::uint32_t count,
                 std::uint64_t first = 1);
  /// `numbers` ascend, one at least. A bitmap reaches 256 numbers far behind those at the start
  /// that follow each other; what is beyond is not in it.
  void gap(EntityId reader, EntityId writer, std::span<const std::int64_t> numbers);
  void acknack(EntityId reader, EntityId writer, const SequenceNumberSet& missing,
               std::uint32_t count, bool is_final);
  /// Fills the message up to `size` bytes, if it is smaller: with a PAD submessage, or, where that
  /// has no room (one to three bytes), with bytes at the end of the last submessage.
  void fill(std::size_t size);

  [[nodiscard]] std::size_t size() const { return message_.size(); }
  [[nodiscard]] const Buffer& buffer() const { return message_; }

 private:
  void sample(EntityId reader, EntityId writer, std::uint64_t sequence_number,
              const ParameterWriter& parameters, std::size_t size, std::uint8_t flags);
  void submessage(SubmessageId id, std::uint8_t flags, const ByteWriter& body);
  void set_length(std::size_t length);

  Buffer message_;
  std::size_t last_ = 0;  ///< where the last submessage starts
};

}  // namespace stormproof::capture::write
