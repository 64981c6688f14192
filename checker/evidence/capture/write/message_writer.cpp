// Submessages and parameters, byte by byte.
#include "checker/evidence/capture/write/message_writer.hpp"

#include <algorithm>

#include "checker/evidence/capture/parameter_list.hpp"

namespace stormproof::capture::write {

namespace {

constexpr std::size_t submessage_header = 4;
constexpr std::size_t data_fields = 20;
constexpr std::size_t parameter_header = 4;
constexpr std::uint8_t little_endian = 0x01;
constexpr std::uint8_t final_flag = 0x02;
constexpr std::uint8_t data_flag = 0x04;
constexpr std::uint8_t key_flag = 0x08;

ByteWriter& add(ByteWriter& body, const SequenceNumberSet& numbers) {
  body.sequence_number(static_cast<std::uint64_t>(numbers.base)).u32(numbers.num_bits);
  for (std::uint32_t word = 0; word * 32 < numbers.num_bits; ++word) body.u32(numbers.bits[word]);
  return body;
}

}  // namespace

ParameterWriter& ParameterWriter::number(std::uint16_t id, std::uint64_t value) {
  out_.u16(id).u16(4).u32(value);
  return *this;
}

ParameterWriter& ParameterWriter::octets(std::uint16_t id, Bytes value) {
  out_.u16(id).u16(value.size()).bytes(value);
  return *this;
}

ParameterWriter& ParameterWriter::text(std::uint16_t id, std::string_view text) {
  ByteWriter value;
  return octets(id, value.text(text).buffer());
}

ParameterWriter& ParameterWriter::guid(std::uint16_t id, const Guid& guid) {
  ByteWriter value;
  return octets(id, value.bytes(guid.prefix.bytes).entity(guid.entity).buffer());
}

ParameterWriter& ParameterWriter::locator(std::uint16_t id, const UdpEnd& end) {
  constexpr std::uint32_t udp_v4 = 1;
  constexpr std::size_t before_v4 = 12;
  ByteWriter value;
  value.u32(udp_v4).u32(end.port).zeros(before_v4).bytes(part(end.address.bytes, before_v4));
  return octets(id, value.buffer());
}

void ask(SequenceNumberSet& missing, std::uint32_t d) {
  const std::int64_t index = std::int64_t{d} + 1 - missing.base;
  if (index < 0 || index >= SequenceNumberSet::most_bits) return;
  const auto bit = static_cast<std::uint32_t>(index);
  missing.num_bits = bit + 1;
  missing.bits[bit / 32] |= 1U << (31 - bit % 32);
}

std::size_t smallest_data(const ParameterWriter& parameters) {
  return submessage_header + data_fields + parameters.buffer().size() + parameter_header;
}

MessageWriter::MessageWriter(VendorId vendor, const GuidPrefix& source) {
  ByteWriter out{ByteOrder::big};
  out.u8('R').u8('T').u8('P').u8('S').u8(2).u8(2).u16(vendor).bytes(source.bytes);
  message_ = std::move(out).take();
}

void MessageWriter::info_dst(const GuidPrefix& destination) {
  ByteWriter body;
  submessage(SubmessageId::info_dst, 0, body.bytes(destination.bytes));
}

void MessageWriter::info_ts(std::int64_t time_ns) {
  constexpr std::uint64_t second = 1'000'000'000;
  const auto time = static_cast<std::uint64_t>(time_ns);
  ByteWriter body;
  body.u32(time / second).u32((time % second << 32U) / second);
  submessage(SubmessageId::info_ts, 0, body);
}

void MessageWriter::data(EntityId reader, EntityId writer, std::uint64_t sequence_number,
                         const ParameterWriter& parameters, std::size_t size) {
  sample(reader, writer, sequence_number, parameters, size, data_flag);
}
void MessageWriter::disposal(EntityId reader, EntityId writer, std::uint64_t sequence_number,
                             const ParameterWriter& key, std::size_t size) {
  sample(reader, writer, sequence_number, key, size, key_flag);
}

void MessageWriter::sample(EntityId reader, EntityId writer, std::uint64_t sequence_number,
                           const ParameterWriter& parameters, std::size_t size,
                           std::uint8_t flags) {
  constexpr std::uint16_t to_inline_qos = 16;
  ByteWriter body;
  body.u16(0).u16(to_inline_qos).entity(reader).entity(writer).sequence_number(sequence_number);
  body.bytes(parameters.buffer());
  const std::size_t smallest = smallest_data(parameters);
  const std::size_t padding = size > smallest ? (size - smallest) / 4 * 4 : 0;
  if (padding > 0) {
    const std::size_t length = padding - parameter_header;
    body.u16(id_of(ParameterId::pad)).u16(length).zeros(length);
  }
  body.u16(id_of(ParameterId::sentinel)).u16(0);
  submessage(SubmessageId::data, flags, body);
}

void MessageWriter::heartbeat(EntityId reader, EntityId writer, std::uint64_t last,
                              std::uint32_t count, std::uint64_t first) {
  ByteWriter body;
  body.entity(reader).entity(writer).sequence_number(first).sequence_number(last).u32(count);
  submessage(SubmessageId::heartbeat, 0, body);
}

void MessageWriter::gap(EntityId reader, EntityId writer, std::span<const std::int64_t> numbers) {
  SequenceNumberSet rest;
  rest.base = numbers.front();
  for (const std::int64_t number : numbers) {
    if (number == rest.base && rest.num_bits == 0) {
      ++rest.base;
    } else {
      ask(rest, static_cast<std::uint32_t>(number - 1));
    }
  }
  ByteWriter body;
  body.entity(reader).entity(writer);
  body.sequence_number(static_cast<std::uint64_t>(numbers.front()));
  submessage(SubmessageId::gap, 0, add(body, rest));
}

void MessageWriter::acknack(EntityId reader, EntityId writer, const SequenceNumberSet& missing,
                            std::uint32_t count, bool is_final) {
  ByteWriter body;
  body.entity(reader).entity(writer);
  submessage(SubmessageId::acknack, is_final ? final_flag : 0, add(body, missing).u32(count));
}

void MessageWriter::fill(std::size_t size) {
  if (size >= message_.size() + submessage_header) {
    ByteWriter body;
    submessage(SubmessageId::pad, 0, body.zeros(size - message_.size() - submessage_header));
  } else if (size > message_.size()) {
    message_.resize(size, 0);
    set_length(size - last_ - submessage_header);
  }
}

void MessageWriter::submessage(SubmessageId id, std::uint8_t flags, const ByteWriter& body) {
  last_ = message_.size();
  ByteWriter out;
  out.u8(static_cast<std::uint8_t>(id)).u8(flags | little_endian).u16(0).bytes(body.buffer());
  message_.insert(message_.end(), out.buffer().begin(), out.buffer().end());
  set_length(body.size());
}

/// octetsToNextHeader of the last submessage.
void MessageWriter::set_length(std::size_t length) {
  message_[last_ + 2] = static_cast<std::uint8_t>(length);
  message_[last_ + 3] = static_cast<std::uint8_t>(length >> 8U);
}

}  // namespace stormproof::capture::write
