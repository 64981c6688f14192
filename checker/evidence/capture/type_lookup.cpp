// Questions and answers as Fast DDS serializes them: delimited CDR 2, little or big endian.
#include "checker/evidence/capture/type_lookup.hpp"

#include <algorithm>
#include <string_view>

namespace stormproof::capture {

namespace {

constexpr std::uint32_t get_types = 0x018252d3;
constexpr std::uint32_t get_dependencies = 0x05aafb31;

std::optional<GuidPrefix> prefix_in(Bytes bytes) {
  GuidPrefix prefix;
  if (bytes.size() != prefix.bytes.size()) return std::nullopt;
  std::ranges::copy(bytes, prefix.bytes.begin());
  return prefix;
}

/// "dds.builtin.TOS." and the prefix in hexadecimal, then the entity.
std::optional<GuidPrefix> prefix_of_instance(Bytes characters) {
  constexpr std::string_view head = "dds.builtin.TOS.";
  const std::string_view name{reinterpret_cast<const char*>(characters.data()), characters.size()};
  GuidPrefix prefix;
  if (!name.starts_with(head) || name.size() < head.size() + 2 * prefix.bytes.size()) {
    return std::nullopt;
  }
  constexpr std::string_view digits = "0123456789abcdef";
  for (std::size_t k = 0; k < prefix.bytes.size(); ++k) {
    const std::size_t high = digits.find(name[head.size() + 2 * k]);
    const std::size_t low = digits.find(name[head.size() + 2 * k + 1]);
    if (high == std::string_view::npos || low == std::string_view::npos) return std::nullopt;
    prefix.bytes[k] = static_cast<std::uint8_t>(16 * high + low);
  }
  return prefix;
}

TypeHash take_hash(Cursor& cursor) {
  TypeHash hash{};
  std::ranges::copy(cursor.take(hash.size()), hash.begin());
  return hash;
}

void read_types(Cursor& cursor, TypeLookup& lookup) {
  cursor.skip(4 + 4 + 4);  // sizes, and which member follows
  for (std::uint32_t left = cursor.u32(); left > 0 && !cursor.failed(); --left) {
    lookup.types.push_back(take_hash(cursor));
  }
}

}  // namespace

std::optional<TypeLookup> type_lookup(const DataSubmessage& data) {
  constexpr std::size_t encapsulation = 4;
  if (data.payload.size() < encapsulation) return std::nullopt;
  const ByteOrder order = (data.payload[1] & 1U) != 0 ? ByteOrder::little : ByteOrder::big;
  Cursor cursor{part(data.payload, encapsulation), order};
  TypeLookup lookup;
  lookup.is_answer = data.writer == entity::lookup_replies_writer;
  const auto asker = prefix_in(cursor.take(lookup.asker.bytes.size()));
  cursor.skip(sizeof(EntityId));
  lookup.number = cursor.sequence_number();
  if (!asker || cursor.failed()) return std::nullopt;
  lookup.asker = *asker;
  if (lookup.is_answer) {
    cursor.skip(4);  // whether there was an exception
  } else {
    lookup.asked = prefix_of_instance(cursor.take(cursor.u32()));
    cursor.skip((4 - cursor.position() % 4) % 4);
  }
  cursor.skip(4);
  const std::uint32_t call = cursor.u32();
  if (call != get_types && call != get_dependencies) return std::nullopt;
  lookup.is_about_dependencies = call == get_dependencies;
  if (!lookup.is_answer) read_types(cursor, lookup);
  if (cursor.failed()) return std::nullopt;
  return lookup;
}

std::optional<TypeHash> type_hash(Bytes type_information, ByteOrder order) {
  constexpr std::uint8_t complete = 0xf2;
  Cursor cursor{type_information, order};
  cursor.skip(4 + 4);  // size; the minimal description
  cursor.skip(cursor.u32());
  cursor.skip(4 + 4 + 4);  // the complete one
  const TypeHash hash = take_hash(cursor);
  if (cursor.failed() || hash.front() != complete) return std::nullopt;
  return hash;
}

}  // namespace stormproof::capture
