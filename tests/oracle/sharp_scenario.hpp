// Random scenarios at the edges of rules: where two times meet exactly, a budget is used up to the
// last byte, a later packet overtakes an earlier one. Dice reach these edges hardly ever, and a
// comparison that does not reach a rule's edge cannot judge the rule.
#pragma once

#include <cstdint>
#include <vector>

#include "model/scenario.hpp"
#include "tests/vectors/wifi_vectors.hpp"

namespace stormproof::oracle {

/// The scenario, moved to one of the edges that the seed chooses.
[[nodiscard]] model::Scenario sharpened(model::Scenario scenario, std::uint64_t seed);

/// The scenario of this seed: as random_scenario.hpp makes it, every other one sharpened; every
/// fourth goes on after the completion of discovery.
[[nodiscard]] model::Scenario varied_scenario(std::uint64_t seed);
[[nodiscard]] model::Scenario varied_fastdds_scenario(std::uint64_t seed);
/// One with what later versions of Fast DDS have, every third one with another way to discover.
[[nodiscard]] model::Scenario random_version_scenario(std::uint64_t seed);
[[nodiscard]] model::Scenario varied_version_scenario(std::uint64_t seed);
/// One without a server, whose endpoints have types.
[[nodiscard]] model::Scenario random_lookup_scenario(std::uint64_t seed);
/// One of several profiles of Fast DDS, without a server; every fourth one with types.
[[nodiscard]] model::Scenario random_mixed_scenario(std::uint64_t seed);
/// One of clients or super clients of a Discovery Server.
[[nodiscard]] model::Scenario varied_server_scenario(std::uint64_t seed);
/// Several servers, none of which looks for another one, which the oracle does not know.
void draw_unlinked_servers(std::uint64_t seed, model::Scenario& scenario);
[[nodiscard]] model::Scenario varied_cyclone_scenario(std::uint64_t seed);
/// One of Fast DDS over a channel of units, or with a sender that stalls, or counted at admission.
[[nodiscard]] model::Scenario varied_wifi_scenario(std::uint64_t seed);
/// One of Fast DDS over listed hosts, transmissions that fail, threads that take time: one of these
/// or several, with frames or units.
[[nodiscard]] model::Scenario varied_fleet_scenario(std::uint64_t seed);

/// One of these with a channel of units whose queues drop frames.
[[nodiscard]] model::Scenario varied_queue_scenario(std::uint64_t seed);

/// A channel of units with limits that matter, and packets for it, by time.
struct PacketList {
  model::WirelessProfile wireless;
  std::uint32_t hosts = 2;
  std::vector<vectors::ChannelPacket> packets;
};
[[nodiscard]] PacketList random_packet_list(std::uint64_t seed);
/// A longer one, for queues that drop frames.
[[nodiscard]] PacketList random_queue_list(std::uint64_t seed);

}  // namespace stormproof::oracle
