// The packets of one participant that nobody has served yet, as they would be written down: of each
// only what differs from the packet before it of its kind and stream. A storm leaves millions of
// packets in the backlogs, nearly all of them HEARTBEATs and repairs that follow a pattern; such a
// packet takes a few bytes here, and a record of a packet more than a hundred. What is written is
// read in the same order, by readers that go on at their own pace; what the last of them has read
// is forgotten.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <utility>

#include "model/engine/packet.hpp"

namespace stormproof::model {

class PacketTape {
 public:
  void write(Packet&& packet);

 private:
  static constexpr std::size_t field_count = 9;
  using Fields = std::array<std::uint32_t, field_count>;
  /// What a packet is told apart from: the last one of its kind and stream, and the last of all.
  struct Context {
    std::array<Fields, 2 * packet_kind_count> before{};
    std::uint64_t number = 0;
    std::int64_t emitted = 0;
  };
  struct Chunk {
    std::unique_ptr<std::uint8_t[]> bytes;
    std::size_t capacity = 0;
    std::size_t end = 0;  // of what is written
  };

 public:
  /// Reads what has been written so far, from the beginning. All readers exist before the first
  /// packet is written, and the tape does not move.
  class Reader {
   public:
    /// What room the next packet, which must be there, takes: its bytes, and how many packets it
    /// stands for.
    struct Size {
      std::uint32_t payload_bytes = 0;
      std::uint32_t copies = 0;
    };
    [[nodiscard]] Size skim(const PacketTape& tape);
    /// All of it. Nobody reads it after this.
    void take(PacketTape& tape, Packet& packet);

   private:
    const std::uint8_t* next(const PacketTape& tape);

    Context context_;
    std::size_t chunk_ = 0;  // of all that were ever there
    std::size_t at_ = 0;     // in this chunk
  };

 private:
  [[nodiscard]] static Fields fields_of(const Packet& packet);
  static void fill(Packet& packet, const Fields& fields);
  static std::size_t context_of(const Packet& packet) {
    return 2 * static_cast<std::size_t>(packet.kind) + index_of(packet.stream);
  }
  std::uint8_t* room_for(std::size_t bytes);
  void add_chunk(std::size_t bytes);
  void forget_before(std::size_t chunk);

  Context context_;
  std::deque<Chunk> chunks_;
  std::size_t forgotten_ = 0;  // chunks
  Chunk spare_;
  /// Of messages: what is no number.
  std::deque<std::pair<decltype(Packet::submessages), decltype(Packet::relayed)>> contents_;
};

}  // namespace stormproof::model
