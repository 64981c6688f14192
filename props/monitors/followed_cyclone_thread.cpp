// What fits into a packet, and what the thread takes next.
#include "props/monitors/followed_cyclone_thread.hpp"

#include <algorithm>
#include <utility>

#include "model/cyclone/endpoints.hpp"

namespace stormproof::props {

namespace {

namespace sizes = model::cyclone;

/// Topics have ports of their own.
bool is_of_topic(const CycloneMessage& message) {
  return message.content.writer >= sizes::writer::first_topic;
}

/// Whether what goes to one may travel with what goes to the other.
bool are_alike(const CycloneDestination& one, const CycloneDestination& other) {
  if (one.is_set != other.is_set) return false;
  const bool of_readers = one.is_set && one.writer != UINT32_MAX;
  if (of_readers && one.writer == other.writer && one.version == other.version) return true;
  return one.addresses.size() == 1 && one.addresses == other.addresses;
}

/// Whether the next message fits into the packet, which is not empty.
bool has_room(const std::vector<CycloneMessage>& packet, const CycloneMessage& next,
              const model::SedpProfile& sedp) {
  const CycloneMessage& first = packet.front();
  if (is_of_topic(first) != is_of_topic(next) || !are_alike(first.to, next.to)) return false;
  const bool repairs = next.is_repair || std::ranges::any_of(packet, &CycloneMessage::is_repair);
  const model::Bytes most = repairs ? sedp.max_rexmit_message_size : sedp.max_message_size;
  return bytes_of(packet) + next.bytes <= most.count();
}

}  // namespace

std::int64_t bytes_of(const Message& content, std::int64_t known, bool multicast) {
  constexpr std::int64_t bits_per_word = 32;
  switch (content.kind) {
    case model::PacketKind::data:
      return sizes::data_bytes(content.writer, content.descriptors.least());
    case model::PacketKind::heartbeat:
      return sizes::heartbeat_bytes;
    case model::PacketKind::acknack: {
      const std::int64_t bits = content.descriptors.empty() ? 0 : known - content.detail;
      const std::int64_t words = (bits + bits_per_word - 1) / bits_per_word;
      return sizes::acknack_bytes + sizes::bitmap_word_bytes * words;
    }
    default:
      return multicast ? sizes::announcement_with_multicast_bytes : sizes::announcement_bytes;
  }
}

std::int64_t bytes_of(const std::vector<CycloneMessage>& packet) {
  std::int64_t bytes = sizes::header_bytes;
  if (!packet.front().to.is_set) bytes += sizes::destination_bytes;
  for (const CycloneMessage& message : packet) bytes += message.bytes;
  return bytes;
}

std::vector<CycloneMessage> CycloneThread::fill(const model::SedpProfile& sedp) {
  if (auto held = std::exchange(held_, {})) open_.push_back(std::move(*held));
  while (!held_ && take_next(sedp)) {
  }
  return std::exchange(open_, {});
}

/// Fires a timer, or takes a message, and packs what that gives; false if there is neither.
bool CycloneThread::take_next(const model::SedpProfile& sedp) {
  if (list.empty() && queue.empty()) return false;
  if (!list.empty()) {
    const std::function<void()> fire = std::move(list.front());
    list.pop_front();
    fire();
  } else {
    give(std::move(queue.front()));
    queue.pop_front();
  }
  std::optional<CycloneMessage> given = std::exchange(given_, {});
  if (!given) return true;
  if (open_.empty() || has_room(open_, *given, sedp)) {
    open_.push_back(std::move(*given));
  } else {
    held_ = std::move(given);
  }
  return true;
}

}  // namespace stormproof::props
