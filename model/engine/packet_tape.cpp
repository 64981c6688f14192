// How a packet is written: a head of five bytes (its length; kind and stream; which fields differ
// and how the descriptors are written), then each of these fields as a difference, in seven bits a
// byte, its number and time likewise, and the descriptors. Size and copies come first, for readers
// that want no more.
#include "model/engine/packet_tape.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <tuple>

namespace stormproof::model {

namespace {

constexpr std::size_t chunk_bytes = 4096;
constexpr std::size_t head_bytes = 5;
constexpr std::size_t longest_number = 10;

// Bits of the head above those of the fields.
constexpr unsigned one_descriptor = 1U << 9;
constexpr unsigned many_descriptors = 1U << 10;
constexpr unsigned has_content = 1U << 11;

std::uint8_t* put(std::uint8_t* to, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) *to++ = static_cast<std::uint8_t>(value | 0x80);
  *to++ = static_cast<std::uint8_t>(value);
  return to;
}

std::uint64_t get(const std::uint8_t*& from) {
  std::uint64_t value = *from & 0x7f;
  for (unsigned shift = 7; (*from++ & 0x80) != 0; shift += 7) {
    value |= static_cast<std::uint64_t>(*from & 0x7f) << shift;
  }
  return value;
}

/// A difference that may be negative as a number that is small if it is near 0.
std::uint32_t folded(std::uint32_t difference) {
  return difference << 1 ^ static_cast<std::uint32_t>(static_cast<std::int32_t>(difference) >> 31);
}
std::uint32_t unfolded(std::uint32_t number) { return number >> 1 ^ (0U - (number & 1)); }

unsigned form_of(const DescriptorSet& set) {
  if (set.empty()) return 0;
  const bool one =
      set.end_word() - set.first_word() == 1 && std::has_single_bit(set.word(set.first_word()));
  return one ? one_descriptor : many_descriptors;
}

std::uint8_t* put(std::uint8_t* to, const DescriptorSet& set) {
  switch (form_of(set)) {
    case one_descriptor:
      return put(to, set.lowest());
    case many_descriptors:
      to = put(to, set.first_word());
      to = put(to, set.end_word());
      for (std::uint32_t k = set.first_word(); k < set.end_word(); ++k) to = put(to, set.word(k));
      return to;
    default:
      return to;
  }
}

DescriptorSet get(const std::uint8_t*& from, unsigned head) {
  DescriptorSet set;
  if ((head & one_descriptor) != 0) {
    const auto d = static_cast<std::uint32_t>(get(from));
    set.add(d / 64, std::uint64_t{1} << d % 64);
  }
  if ((head & many_descriptors) != 0) {
    auto k = static_cast<std::uint32_t>(get(from));
    for (const auto end = static_cast<std::uint32_t>(get(from)); k < end; ++k) {
      set.add(k, get(from));
    }
  }
  return set;
}

}  // namespace

PacketTape::Fields PacketTape::fields_of(const Packet& packet) {
  unsigned flags = static_cast<unsigned>(packet.use) << 8 | packet.port;
  for (const bool flag : {packet.from_repair, packet.carries_initial, packet.carries_heartbeat,
                          packet.initial_acknack, packet.to_group, packet.to_nobody}) {
    flags = flags << 1 | (flag ? 1U : 0U);
  }
  return {packet.payload_bytes, packet.copies,     packet.pair,
          packet.rank_limit,    packet.detail,     packet.initial_data,
          packet.repair_data,   packet.heartbeats, flags};
}

void PacketTape::fill(Packet& packet, const Fields& fields) {
  packet.payload_bytes = fields[0];
  packet.copies = fields[1];
  packet.pair = fields[2];
  packet.rank_limit = fields[3];
  packet.detail = fields[4];
  packet.initial_data = fields[5];
  packet.repair_data = fields[6];
  packet.heartbeats = static_cast<std::uint16_t>(fields[7]);
  unsigned flags = fields[8];
  for (bool* flag : {&packet.to_nobody, &packet.to_group, &packet.initial_acknack,
                     &packet.carries_heartbeat, &packet.carries_initial, &packet.from_repair}) {
    *flag = (flags & 1) != 0;
    flags >>= 1;
  }
  packet.port = static_cast<std::uint8_t>(flags);
  packet.use = static_cast<TrafficClass>(flags >> 8);
}

void PacketTape::write(Packet&& packet) {
  const DescriptorSet& descriptors = packet.descriptors;
  const std::size_t words = descriptors.end_word() - descriptors.first_word();
  std::uint8_t* const head = room_for(head_bytes + (field_count + words + 4) * longest_number);
  std::uint8_t* to = head + head_bytes;
  const std::size_t context = context_of(packet);
  Fields& before = context_.before[context];
  const Fields fields = fields_of(packet);
  unsigned differing = 0;
  for (std::size_t k = 0; k < field_count; ++k) {
    differing |= (fields[k] != before[k] ? 1U : 0U) << k;
  }
  for (unsigned left = differing; left != 0; left &= left - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(left));
    to = put(to, folded(fields[k] - before[k]));
  }
  before = fields;
  to = put(to, packet.number - std::exchange(context_.number, packet.number));
  const std::int64_t emitted = packet.emitted.count();
  to = put(to, static_cast<std::uint64_t>(emitted - std::exchange(context_.emitted, emitted)));
  to = put(to, descriptors);
  unsigned bits = differing | form_of(descriptors);
  if (packet.submessages || packet.relayed) {
    bits |= has_content;
    contents_.emplace_back(std::move(packet.submessages), std::move(packet.relayed));
  }
  const auto length = static_cast<std::size_t>(to - head);
  assert(length < std::size_t{1} << 16);  // the longest streams take half of that
  const std::array<std::size_t, head_bytes> bytes{length, length >> 8, context, bits, bits >> 8};
  for (std::size_t k = 0; k < head_bytes; ++k) head[k] = static_cast<std::uint8_t>(bytes[k]);
  chunks_.back().end += length;
}

std::uint8_t* PacketTape::room_for(std::size_t bytes) {
  if (chunks_.empty() || chunks_.back().capacity - chunks_.back().end < bytes) [[unlikely]] {
    add_chunk(bytes);
  }
  return chunks_.back().bytes.get() + chunks_.back().end;
}

void PacketTape::add_chunk(std::size_t bytes) {
  if (spare_.bytes != nullptr && spare_.capacity >= bytes) {
    chunks_.push_back(std::exchange(spare_, {}));
  } else {
    const std::size_t capacity = std::max(chunk_bytes, bytes);
    chunks_.push_back({std::make_unique_for_overwrite<std::uint8_t[]>(capacity), capacity, 0});
  }
}

void PacketTape::forget_before(std::size_t chunk) {
  for (; forgotten_ < chunk; ++forgotten_) {
    spare_ = std::move(chunks_.front());
    spare_.end = 0;
    chunks_.pop_front();
  }
}

/// The next record; the reader stands behind it.
const std::uint8_t* PacketTape::Reader::next(const PacketTape& tape) {
  const Chunk* chunk = &tape.chunks_[chunk_ - tape.forgotten_];
  if (at_ == chunk->end) {
    chunk = &tape.chunks_[++chunk_ - tape.forgotten_];
    at_ = 0;
  }
  const std::uint8_t* record = chunk->bytes.get() + at_;
  at_ += record[0] | static_cast<std::size_t>(record[1]) << 8;
  return record;
}

PacketTape::Reader::Size PacketTape::Reader::skim(const PacketTape& tape) {
  const std::uint8_t* record = next(tape);
  Fields& fields = context_.before[record[2]];
  const unsigned bits = record[3];
  const std::uint8_t* from = record + head_bytes;
  for (const std::size_t k : {0U, 1U}) {
    if ((bits >> k & 1) != 0) fields[k] += unfolded(static_cast<std::uint32_t>(get(from)));
  }
  return {fields[0], fields[1]};
}

void PacketTape::Reader::take(PacketTape& tape, Packet& packet) {
  const std::uint8_t* record = next(tape);
  const std::size_t context = record[2];
  const unsigned bits = record[3] | static_cast<unsigned>(record[4]) << 8;
  const std::uint8_t* from = record + head_bytes;
  Fields& fields = context_.before[context];
  for (unsigned left = bits & (one_descriptor - 1); left != 0; left &= left - 1) {
    fields[static_cast<std::size_t>(std::countr_zero(left))] +=
        unfolded(static_cast<std::uint32_t>(get(from)));
  }
  packet.kind = static_cast<PacketKind>(context / 2);
  packet.stream = streams[context % 2];
  fill(packet, fields);
  packet.number = context_.number += get(from);
  packet.emitted = Nanoseconds{context_.emitted += static_cast<std::int64_t>(get(from))};
  packet.descriptors = get(from, bits);
  packet.submessages.reset();
  packet.relayed.reset();
  if ((bits & has_content) != 0) {
    std::tie(packet.submessages, packet.relayed) = std::move(tape.contents_.front());
    tape.contents_.pop_front();
  }
  tape.forget_before(chunk_);
}

}  // namespace stormproof::model
