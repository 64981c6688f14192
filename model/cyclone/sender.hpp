// Sends the packets of Cyclone DDS's event threads, copy by copy, and counts what is in them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "model/cyclone/event_threads.hpp"
#include "model/engine/packet.hpp"

namespace stormproof::model {
class Network;  // model/engine/network.hpp
}  // namespace stormproof::model

namespace stormproof::model::cyclone {

class Sender {
 public:
  using Number = std::uint32_t;

  Sender(RunState& run, Network& network, const EventThreads& threads);

  /// A copy of the packet goes to a participant, or to the group; `packet` is as it is made for it.
  void send(Number i, Number to, model::Packet packet);
  /// It goes over the network, and counts.
  void emit(Number i, model::Packet&& packet);
  /// Counts what is in a packet that is admitted.
  void count_admitted(const model::Packet& packet);
  /// What has been sent over the relation is new again.
  void forget(Number relation) { std::ranges::fill(delivered_[relation], std::uint64_t{0}); }
  [[nodiscard]] bool stalls(Number i) const;

 private:
  TrafficClass count(const Submessage& m, Number pair, bool to_group);
  static TrafficClass count_control(const Submessage& m, Counts& counts,
                                    std::uint64_t& user_control);

  RunState& run_;
  Network& network_;
  const Number stride_;  ///< writers of each participant
  // Samples that have been sent: to the group, by writer, stride · participant + writer; by
  // unicast, by relation, stride · pair + writer.
  std::vector<std::vector<std::uint64_t>> delivered_to_group_;
  std::vector<std::vector<std::uint64_t>> delivered_;
};

}  // namespace stormproof::model::cyclone
