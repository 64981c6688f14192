// The wire format of RTPS messages.
#include "checker/evidence/capture/rtps_message.hpp"

#include <algorithm>
#include <bit>
#include <string_view>

#include "checker/evidence/capture/parameter_list.hpp"

namespace stormproof::capture {

namespace {

constexpr std::size_t message_header_size = 20;
constexpr std::size_t prefix_size = 12;

GuidPrefix prefix_of(Bytes bytes) {
  GuidPrefix prefix;
  if (bytes.size() == prefix_size) std::ranges::copy(bytes, prefix.bytes.begin());
  return prefix;
}

/// Entity ids are octets, so they have no byte order.
EntityId entity_id(Cursor& cursor) { return Cursor{cursor.take(4)}.u32(); }

std::optional<SequenceNumberSet> sequence_number_set(Cursor& cursor) {
  SequenceNumberSet set;
  set.base = cursor.sequence_number();
  set.num_bits = cursor.u32();
  if (set.num_bits > SequenceNumberSet::most_bits) return std::nullopt;
  for (std::uint32_t word = 0; word * 32 < set.num_bits; ++word) set.bits[word] = cursor.u32();
  if (cursor.failed()) return std::nullopt;
  return set;
}

}  // namespace

std::optional<MessageHeader> message_header(Bytes message) {
  constexpr std::string_view magic = "RTPS";
  constexpr std::uint8_t major_version = 2;
  if (message.size() < message_header_size ||
      !std::equal(magic.begin(), magic.end(), message.begin()) || message[4] != major_version) {
    return std::nullopt;
  }
  MessageHeader header;
  header.vendor = static_cast<VendorId>(message[6] << 8U | message[7]);
  header.source = prefix_of(message.subspan(8, prefix_size));
  return header;
}

SubmessageReader::SubmessageReader(Bytes message) : rest_{part(message, message_header_size)} {}

std::optional<Submessage> SubmessageReader::next() {
  constexpr std::size_t header_size = 4;
  if (rest_.empty()) return std::nullopt;
  Submessage submessage;
  if (rest_.size() < header_size) {
    is_cut_ = true;
    rest_ = {};
    return std::nullopt;
  }
  submessage.id = static_cast<SubmessageId>(rest_[0]);
  submessage.flags = rest_[1];
  std::size_t length = Cursor{rest_.subspan(2, 2), submessage.order()}.u16();
  const std::size_t available = rest_.size() - header_size;
  // Length 0 means "until the end of the message", except where nothing to carry is usual.
  if (length == 0 && submessage.id != SubmessageId::pad && submessage.id != SubmessageId::info_ts) {
    length = available;
  }
  if (length > available) {
    is_cut_ = true;
    rest_ = {};
    return std::nullopt;
  }
  submessage.body = rest_.subspan(header_size, length);
  submessage.size = header_size + length;
  rest_ = rest_.subspan(submessage.size);
  return submessage;
}

std::uint32_t SequenceNumberSet::size() const {
  std::uint32_t members = 0;
  for (std::uint32_t word = 0; word * 32 < num_bits; ++word) {
    const std::uint32_t valid = std::min(num_bits - word * 32, 32U);
    members += static_cast<std::uint32_t>(std::popcount(bits[word] >> (32U - valid)));
  }
  return members;
}

std::optional<DataSubmessage> decode_data(const Submessage& submessage) {
  constexpr std::uint8_t has_inline_qos = 0x02;
  constexpr std::uint8_t has_data = 0x04;
  constexpr std::uint8_t has_key = 0x08;
  constexpr std::uint8_t key_in_fragment = 0x04;
  const bool is_fragment = submessage.id == SubmessageId::data_frag;
  Cursor cursor{submessage.body, submessage.order()};
  DataSubmessage data;
  cursor.skip(2);
  const std::size_t to_inline_qos = cursor.u16();
  const std::size_t counted_from = cursor.position();
  data.reader = entity_id(cursor);
  data.writer = entity_id(cursor);
  data.sequence_number = cursor.sequence_number();
  if (is_fragment) data.fragment = cursor.u32();
  if (cursor.failed() || (is_fragment && data.fragment == 0)) return std::nullopt;
  if (to_inline_qos < cursor.position() - counted_from ||
      to_inline_qos > submessage.body.size() - counted_from) {
    return std::nullopt;
  }
  Bytes rest = part(submessage.body, counted_from + to_inline_qos);
  if ((submessage.flags & has_inline_qos) != 0) {
    const auto length = parameter_list_size(rest, submessage.order());
    data.inline_qos_is_valid = length.has_value();
    data.inline_qos = part(rest, 0, length.value_or(0));
    rest = length ? part(rest, *length) : Bytes{};
  }
  data.has_key_only = (submessage.flags & (is_fragment ? key_in_fragment : has_key)) != 0;
  if (is_fragment || (submessage.flags & (has_data | has_key)) != 0) data.payload = rest;
  return data;
}

std::optional<HeartbeatSubmessage> decode_heartbeat(const Submessage& submessage) {
  constexpr std::uint8_t final_flag = 0x02;
  constexpr std::uint8_t liveliness_flag = 0x04;
  Cursor cursor{submessage.body, submessage.order()};
  HeartbeatSubmessage heartbeat;
  heartbeat.reader = entity_id(cursor);
  heartbeat.writer = entity_id(cursor);
  heartbeat.first = cursor.sequence_number();
  heartbeat.last = cursor.sequence_number();
  heartbeat.count = cursor.u32();
  heartbeat.is_final = (submessage.flags & final_flag) != 0;
  heartbeat.is_liveliness = (submessage.flags & liveliness_flag) != 0;
  if (cursor.failed()) return std::nullopt;
  return heartbeat;
}

std::optional<AcknackSubmessage> decode_acknack(const Submessage& submessage) {
  constexpr std::uint8_t final_flag = 0x02;
  Cursor cursor{submessage.body, submessage.order()};
  AcknackSubmessage acknack;
  acknack.reader = entity_id(cursor);
  acknack.writer = entity_id(cursor);
  const auto set = sequence_number_set(cursor);
  acknack.count = cursor.u32();
  acknack.is_final = (submessage.flags & final_flag) != 0;
  if (!set || cursor.failed()) return std::nullopt;
  acknack.missing = *set;
  return acknack;
}

std::optional<GapSubmessage> decode_gap(const Submessage& submessage) {
  Cursor cursor{submessage.body, submessage.order()};
  GapSubmessage gap;
  gap.reader = entity_id(cursor);
  gap.writer = entity_id(cursor);
  gap.start = cursor.sequence_number();
  const auto set = sequence_number_set(cursor);
  if (!set || cursor.failed()) return std::nullopt;
  gap.list = *set;
  return gap;
}

std::optional<GuidPrefix> decode_prefix(const Submessage& submessage) {
  constexpr std::size_t before_source = 8;  // unused, version, vendor
  Cursor cursor{submessage.body};
  if (submessage.id == SubmessageId::info_src) cursor.skip(before_source);
  const Bytes bytes = cursor.take(prefix_size);
  if (cursor.failed()) return std::nullopt;
  return prefix_of(bytes);
}

}  // namespace stormproof::capture
