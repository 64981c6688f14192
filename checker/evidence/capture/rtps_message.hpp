// An RTPS message, submessage by submessage (RTPS 2.5, sections 8.3 and 9.4), without copies: a
// pull parser over the bytes of one UDP datagram, and decoders for the submessages that count.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "checker/evidence/capture/bytes.hpp"
#include "checker/evidence/capture/identifiers.hpp"

namespace stormproof::capture {

enum class SubmessageId : std::uint8_t {
  pad = 0x01,
  acknack = 0x06,
  heartbeat = 0x07,
  gap = 0x08,
  info_ts = 0x09,
  info_src = 0x0c,
  info_reply_ip4 = 0x0d,
  info_dst = 0x0e,
  info_reply = 0x0f,
  nack_frag = 0x12,
  heartbeat_frag = 0x13,
  data = 0x15,
  data_frag = 0x16,
  statistics = 0x80  ///< of Fast DDS: what it counts about its locators, in every datagram
};

struct Submessage {
  SubmessageId id = SubmessageId::pad;  ///< may be a value that has no name: of a vendor, secured
  std::uint8_t flags = 0;
  std::size_t size = 0;  ///< with its header, in bytes
  Bytes body{};

  [[nodiscard]] ByteOrder order() const {
    return (flags & 1U) != 0 ? ByteOrder::little : ByteOrder::big;
  }
};

struct MessageHeader {
  VendorId vendor = 0;
  GuidPrefix source{};
};
/// Nothing if the datagram is no RTPS 2.x message.
[[nodiscard]] std::optional<MessageHeader> message_header(Bytes message);

/// The submessages of a message with a valid header.
class SubmessageReader {
 public:
  explicit SubmessageReader(Bytes message);
  /// Nothing at the end; `is_cut` says whether the end lies inside a submessage.
  [[nodiscard]] std::optional<Submessage> next();
  [[nodiscard]] bool is_cut() const { return is_cut_; }

 private:
  Bytes rest_;
  bool is_cut_ = false;
};

struct DataSubmessage {
  EntityId reader = 0;
  EntityId writer = 0;
  std::int64_t sequence_number = 0;
  bool has_key_only = false;   ///< the payload is a key, not a sample
  std::uint32_t fragment = 0;  ///< number of the first fragment (from 1 on); 0: DATA, not DATA_FRAG
  bool inline_qos_is_valid = true;
  Bytes inline_qos{};  ///< a parameter list without encapsulation
  Bytes payload{};     ///< with its encapsulation; empty if there is none
};

struct HeartbeatSubmessage {
  EntityId reader = 0;
  EntityId writer = 0;
  std::int64_t first = 0;
  std::int64_t last = 0;
  std::uint32_t count = 0;
  bool is_final = false;
  bool is_liveliness = false;
};

/// Numbers base … base + num_bits − 1, of which those with a bit are in the set.
struct SequenceNumberSet {
  static constexpr std::uint32_t most_bits = 256;

  std::int64_t base = 0;
  std::uint32_t num_bits = 0;                        ///< 0 … 256
  std::array<std::uint32_t, most_bits / 32> bits{};  ///< number base is the highest bit of bits[0]

  /// Whether `base + index` is in the set.
  [[nodiscard]] bool has(std::uint32_t index) const {
    return index < num_bits && (bits[index / 32] >> (31U - index % 32) & 1U) != 0;
  }
  [[nodiscard]] std::uint32_t size() const;
};

struct AcknackSubmessage {
  EntityId reader = 0;
  EntityId writer = 0;
  SequenceNumberSet missing{};
  std::uint32_t count = 0;
  bool is_final = false;
};

/// Irrelevant numbers: start … list.base − 1, and those in the list.
struct GapSubmessage {
  EntityId reader = 0;
  EntityId writer = 0;
  std::int64_t start = 0;
  SequenceNumberSet list{};
};

/// Each gives nothing if the submessage is too short or a length in it is impossible.
[[nodiscard]] std::optional<DataSubmessage> decode_data(const Submessage& submessage);
[[nodiscard]] std::optional<HeartbeatSubmessage> decode_heartbeat(const Submessage& submessage);
[[nodiscard]] std::optional<AcknackSubmessage> decode_acknack(const Submessage& submessage);
[[nodiscard]] std::optional<GapSubmessage> decode_gap(const Submessage& submessage);
/// The prefix in an INFO_DST or INFO_SRC.
[[nodiscard]] std::optional<GuidPrefix> decode_prefix(const Submessage& submessage);

}  // namespace stormproof::capture
