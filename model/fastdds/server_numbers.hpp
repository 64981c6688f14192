// How what the rules of a Discovery Server are about is numbered (fsm/composition/server.hpp).
#pragma once

#include <cstdint>

#include "model/engine/columns.hpp"
#include "model/fastdds/relayed.hpp"

namespace stormproof::model::fastdds {

/// Only the server and its pairs with clients have any of these, so there are rows for the clients
/// and for the relays. Observers and the queue hear of the pair, or of the server, and of the
/// relay.
struct ServerNumbers : PlainColumns {
  static constexpr bool is_relayed(comp::Owner owner) {
    return (owner.indices & comp::owner::stream_index) != 0;
  }
  template <comp::Owner owner>
  static std::uint32_t rows(const RunState& run) {
    const std::uint32_t relays = is_relayed(owner) ? relay::count : 1;
    const bool by_client = (owner.indices & comp::owner::peer_index) != 0;
    return relays * (by_client ? run.scenario.deployment.size() : 1);
  }
  static std::uint32_t row(comp::Owner owner, std::uint32_t n, const RunState& run) {
    const std::uint32_t relays = is_relayed(owner) ? relay::count : 1;
    if ((owner.indices & comp::owner::peer_index) == 0) return n % relays;
    return relays * client_of(n / relays, run) + n % relays;
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
  /// The client of a pair with the server.
  static std::uint32_t client_of(std::uint32_t pair, const RunState& run) {
    const Pair& p = run.topology.pair(pair);
    return p.source == run.scenario.deployment.size() ? p.destination : p.source;
  }
};

}  // namespace stormproof::model::fastdds
