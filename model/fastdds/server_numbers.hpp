// How what the rules of a Discovery Server are about is numbered (fsm/composition/server.hpp).
#pragma once

#include <algorithm>
#include <cstdint>

#include "model/engine/columns.hpp"
#include "model/fastdds/relayed.hpp"

namespace stormproof::model::fastdds {

/// Only servers and their pairs with clients have any of these, so there are rows for each server,
/// its relays and whoever may be a client of it. Observers and the queue hear of the pair, or of
/// the server, and of the relay.
struct ServerNumbers : PlainColumns {
  static constexpr bool is_relayed(comp::Owner owner) {
    return (owner.indices & comp::owner::stream_index) != 0;
  }
  template <comp::Owner owner>
  static std::uint32_t rows(const RunState& run) {
    const std::uint32_t relays = is_relayed(owner) ? relay::count : 1;
    const bool by_client = (owner.indices & comp::owner::peer_index) != 0;
    const std::uint32_t servers = run.topology.server_count();
    return relays * servers * (by_client ? run.topology.participant_count() : 1);
  }
  static std::uint32_t row(comp::Owner owner, std::uint32_t n, const RunState& run) {
    const std::uint32_t relays = is_relayed(owner) ? relay::count : 1;
    if ((owner.indices & comp::owner::peer_index) == 0) {
      const std::uint32_t first = run.topology.first_server();
      return relays * (std::max(n / relays, first) - first) + n % relays;
    }
    return relays * row_of_pair(n / relays, run.topology) + n % relays;
  }
  /// Of the pair of a server and a client of it, in either direction.
  static std::uint32_t row_of_pair(std::uint32_t pair, const Topology& topology) {
    const Pair& ends = topology.pair(pair);
    const bool from_server = topology.is_server(ends.source);
    const std::uint32_t server = from_server ? ends.source : ends.destination;
    const std::uint32_t client = from_server ? ends.destination : ends.source;
    const std::uint32_t first = topology.first_server();  // only a mistake has two clients
    return (std::max(server, first) - first) * topology.participant_count() + client;
  }
  static constexpr MachineRef::Kind kind(comp::Owner owner) {
    const bool of_pair = (owner.indices & comp::owner::peer_index) != 0;
    return of_pair ? MachineRef::Kind::pair : MachineRef::Kind::participant;
  }
  static constexpr std::uint32_t subject(comp::Owner owner, std::uint32_t n) {
    return is_relayed(owner) ? n / relay::count : n;
  }
  static constexpr std::uint32_t detail(comp::Owner owner, std::uint32_t n) {
    return is_relayed(owner) ? n % relay::count : 0;
  }
  static constexpr std::uint32_t number(comp::Owner owner, const Event& event) {
    return is_relayed(owner) ? relay::count * event.subject + event.detail : event.subject;
  }
};

}  // namespace stormproof::model::fastdds
