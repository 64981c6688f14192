// The border between the network (model/engine/network.hpp) and a DDS implementation
// (model/paper/): packets go down through `Network::emit`, their fate and the protocol's timers
// come back through this interface. Another vendor's writer is another class behind it.
#pragma once

#include <optional>
#include <vector>

#include "model/engine/event_queue.hpp"
#include "model/engine/packet.hpp"
#include "model/run_result.hpp"

namespace stormproof::model {

class Implementation {
 public:
  virtual ~Implementation() = default;

  /// Schedules what happens before the run.
  virtual void start() = 0;
  /// A protocol event is due.
  virtual void handle(const Event& event) = 0;
  /// The participant that acts in a protocol event, if it does so only when it can send
  /// (`sender: stalls`).
  [[nodiscard]] virtual std::optional<std::uint32_t> sender_of(const Event&) const { return {}; }
  /// Counts the messages in a packet that is admitted (`count_at: admission`).
  virtual void count(const Packet&) {}
  /// The last source-side fragment of the packet has been served.
  virtual void source_completed(const Packet& packet) = 0;
  /// Whether each receiver of a packet has a reception event of its own. Otherwise a packet is
  /// processed as one reception, whoever it reaches.
  [[nodiscard]] virtual bool receives_separately() const = 0;
  /// The participants that a packet reaches over the network, in the order of these events.
  [[nodiscard]] virtual std::vector<std::uint32_t> receivers(const Packet& packet) const = 0;
  /// When the participant receives what reaches it now, if that is later.
  [[nodiscard]] virtual std::optional<Nanoseconds> receives_later(std::uint32_t) const {
    return {};
  }
  /// The packet has arrived completely, and was not lost. `receiver` means something only if
  /// `receives_separately`.
  virtual void received(const Packet& packet, std::uint32_t receiver) = 0;
  /// Makes an ACKNACK ask for what is missing now. A correct run never does: the bitmap is a
  /// snapshot (`Mutation::live_bitmaps`).
  virtual void renew_bitmap(Packet& acknack) = 0;
  /// The pair that a packet with several copies goes to after this one.
  [[nodiscard]] virtual std::uint32_t next_recipient(const Packet& packet,
                                                     std::uint32_t pair) const = 0;
  /// Descriptors that have not reached a receiver, at most `limit` of them, in ascending order.
  [[nodiscard]] virtual std::vector<MissingDescriptor> missing(std::size_t limit) = 0;
};

}  // namespace stormproof::model
