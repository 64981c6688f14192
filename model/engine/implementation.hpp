// The border between the network (model/engine/network.hpp) and a DDS implementation (model/paper/): packets go
// down through `Network::emit`, their fate and the protocol's timers come back through this interface. Another
// vendor's writer is another class behind it.
#pragma once

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
  /// The last source-side fragment of the packet has been served.
  virtual void source_completed(const Packet& packet) = 0;
  /// The packet has arrived completely, and was not lost.
  virtual void received(const Packet& packet) = 0;
  /// The first pair from `pair` on, among those of one source, that a packet with several copies goes to.
  [[nodiscard]] virtual std::uint32_t next_recipient(const Packet& packet,
                                                     std::uint32_t pair) const = 0;
  /// Descriptors that have not reached a receiver, at most `limit` of them, in ascending order.
  [[nodiscard]] virtual std::vector<MissingDescriptor> missing(std::size_t limit) = 0;
};

}  // namespace stormproof::model
