// From slots to messages, and from packets to slots.
#include "checker/engines/explorer/cyclone_messages.hpp"

#include <bit>

#include "model/cyclone/endpoints.hpp"

namespace stormproof::explorer {

namespace {

namespace wire = model::cyclone;
using model::Submessage;

constexpr std::uint32_t source_of_samples = 0;  // participants
constexpr std::uint32_t their_reader = 1;

std::int64_t bytes_of(const Submessage& content) {
  if (content.kind == Submessage::Kind::data) {
    return wire::data_bytes(wire::writer::publications, content.sample);
  }
  if (content.kind == Submessage::Kind::heartbeat) return wire::heartbeat_bytes;
  // A word has room for more samples than are explored.
  return wire::acknack_bytes + (content.bitmap.empty() ? 0 : wire::bitmap_word_bytes);
}

Submessage content_of(const Slot& slot) {
  Submessage content;
  content.participant = source_of_samples;
  content.writer = wire::writer::publications;
  content.count = slot.count;
  content.sample = slot.number;
  if (slot.what == What::data) {
    content.kind = Submessage::Kind::data;
    content.sample = static_cast<std::uint32_t>(std::countr_zero(slot.set));
  } else if (slot.what == What::heartbeat) {
    content.kind = Submessage::Kind::heartbeat;
    content.directed = slot.has(Slot::directed);
  } else {
    content.kind = Submessage::Kind::acknack;
    content.initial = slot.has(Slot::initial);
    content.bitmap.add(0, slot.set);
  }
  return content;
}

Slot slot_of(const Submessage& m) {
  const auto number = static_cast<std::uint8_t>(m.sample);
  const auto count = static_cast<std::uint16_t>(m.count);
  if (m.kind == Submessage::Kind::data) return {What::data, 0, member(m.sample)};
  if (m.kind == Submessage::Kind::heartbeat) {
    return {What::heartbeat, m.directed ? Slot::directed : std::uint8_t{0}, 0, number, 0, count};
  }
  const auto listed = static_cast<std::uint16_t>(m.bitmap.word(0));
  return {What::acknack, m.initial ? Slot::initial : std::uint8_t{0}, listed, number, 0, count};
}

/// The submessage joins the part, if both are one.
bool joins(Slot& part, const Slot& next) {
  if (part.what != What::data || part.has(Slot::carries_heartbeat)) return false;
  if (next.what == What::heartbeat) {
    part.flags |= Slot::carries_heartbeat | next.flags;
    part.number = next.number;
    part.count = next.count;
    return true;
  }
  if (next.what != What::data || next.set <= part.set) return false;
  part.set |= next.set;
  return true;
}

}  // namespace

wire::Message message_of(const Slot& slot) {
  wire::Message message;
  message.content = content_of(slot);
  message.bytes = bytes_of(message.content);
  message.retransmission = slot.what == What::data && slot.has(Slot::from_repair);
  message.to = wire::Destination::only(from_writer(slot.what) ? their_reader : source_of_samples);
  if (slot.has(Slot::to_set)) {
    message.to.is_set = true;
    message.to.writer = wire::writer::publications;
  }
  return message;
}

std::vector<Slot> parts_of(std::span<const Submessage> contents) {
  std::vector<Slot> parts;
  for (const Submessage& m : contents) {
    if (m.kind == Submessage::Kind::spdp || m.participant != source_of_samples) continue;
    if (m.writer != wire::writer::publications) continue;
    const Slot next = slot_of(m);
    if (!parts.empty() && joins(parts.back(), next)) continue;
    if (!parts.empty()) parts.back().flags |= Slot::goes_on;
    parts.push_back(next);
  }
  return parts;
}

}  // namespace stormproof::explorer
