// IGMP (RFC 2236 version 2, RFC 3376 version 3): who asks which groups are listened to, and who
// answers. A switch that forwards a group only to its listeners ("snooping") learns them from the
// answers, and forgets them after 260 s if nobody asks.
#pragma once

#include <cstdint>
#include <map>
#include <set>

#include "checker/evidence/capture/address.hpp"
#include "checker/evidence/capture/ip_packet.hpp"

namespace stormproof::capture {

/// What a capture shows of it.
struct Igmp {
  std::set<Address> queriers{};                    ///< who asks
  std::map<Address, std::set<Address>> members{};  ///< of a group: who said that it listens
};

/// Adds what this packet says; anything else than IGMP says nothing.
void add_igmp(const IpPacket& packet, Igmp& igmp);

}  // namespace stormproof::capture
