// The oracle of `implementation: fastdds`: a second, deliberately naive simulator of the rules in
// specs/guide/fastdds.md. Like the paper's oracle it exists to be compared with the product on any
// scenario, and shares nothing with it but the plain input structs.
#pragma once

#include <cstdint>
#include <vector>

#include "model/scenario.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/vectors/wifi_vectors.hpp"

namespace stormproof::oracle {

/// The counts and the missing descriptors are those of cross-host pairs.
struct FastddsOutcome : Outcome {
  std::int64_t user_control = 0;  ///< HEARTBEATs and ACKNACKs of control-only relations, on top
  std::uint64_t replaced_messages = 0;  ///< piggybacks that needed a new message, to all readers
  std::int64_t lookup = 0;              ///< questions and answers about types, by receiver
  // With a Discovery Server.
  std::int64_t pdp_data = 0;
  std::int64_t pdp_heartbeat = 0;
  std::int64_t pdp_acknack = 0;
  std::int64_t gap = 0;
  /// How many know somebody who is gone for ever, or will be.
  std::int64_t held_in_vain = 0;
};

/// Runs the scenario as `run` does. Takes the profile for one of `implementation: fastdds`,
/// whatever it says.
/// Throws std::invalid_argument if the deployment has no cross-host pair or a participant is done
/// before it starts.
[[nodiscard]] FastddsOutcome run_fastdds(const model::Scenario& scenario, const EventLog& log = {},
                                         FastddsMistake mistake = FastddsMistake::none,
                                         std::uint64_t max_events = 0,
                                         WifiMistake of_wifi = WifiMistake::none,
                                         ServerMistake of_server = ServerMistake::none);

/// When the packets, given by time, have arrived over a channel of units, or −1.
[[nodiscard]] std::vector<std::int64_t> feed_units(
    const model::WirelessProfile& wireless, std::uint32_t hosts,
    const std::vector<vectors::ChannelPacket>& packets, WifiMistake mistake = WifiMistake::none);

}  // namespace stormproof::oracle
