// What a packet of the model holds, byte for byte: the model keeps only the sum
// (specs/guide/model.md and specs/guide/fastdds.md, sizes). From it follow whether there is an
// INFO_DST, and where each DATA ends.
#pragma once

#include <algorithm>
#include <cstdint>

#include "checker/evidence/capture/write/message_writer.hpp"
#include "model/engine/packet.hpp"
#include "model/packet_sizes.hpp"

namespace stormproof::capture::write {

class PacketLayout {
 public:
  explicit PacketLayout(const model::DdsProfile& dds) : sizes_{model::packet_sizes(dds)} {}

  /// How many HEARTBEATs a DATA or HEARTBEAT packet holds.
  [[nodiscard]] static std::uint32_t heartbeats_in(const model::Packet& packet) {
    const bool is_alone = packet.kind == model::PacketKind::heartbeat;
    return std::max<std::uint32_t>(packet.heartbeats, is_alone ? 1 : 0);
  }

  /// UDP payload of a HEARTBEAT to one reader.
  [[nodiscard]] std::int64_t heartbeat_bytes() const { return sizes_.heartbeat; }

  /// Whether there is an INFO_DST: where it is no part of the header, it is left out, and the
  /// packet is smaller, when a message goes to several.
  [[nodiscard]] bool names_destination(const model::Packet& packet) const {
    if (sizes_.destination == 0) return true;
    std::int64_t without = sizes_.header + heartbeats_in(packet) * sizes_.heartbeat_in_data;
    packet.descriptors.for_each(
        [&](std::uint32_t d) { without += sizes_.descriptor(packet.stream, d); });
    return packet.payload_bytes > without;
  }

  /// Calls `visit(d, end)` for each descriptor of the packet, ascending: its INFO_TS and DATA are
  /// to end `end` bytes after the start of the payload. The first starts after `header` bytes; the
  /// last ends `tail` bytes before the end.
  template <class Visit>
  void for_each_data(const model::Packet& packet, std::size_t header, std::size_t tail,
                     Visit&& visit) const {
    std::uint32_t left = packet.descriptors.count();
    auto end = static_cast<std::int64_t>(header);
    packet.descriptors.for_each([&](std::uint32_t d) {
      end += sizes_.descriptor(packet.stream, d);
      if (--left == 0) end = std::int64_t{packet.payload_bytes} - static_cast<std::int64_t>(tail);
      visit(d, static_cast<std::size_t>(std::max<std::int64_t>(end, 0)));
    });
  }

 private:
  model::PacketSizes sizes_;
};

}  // namespace stormproof::capture::write
