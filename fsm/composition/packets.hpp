// What the packets of discovery say, and what every rule can read besides.
#pragma once

#include "fsm/composition/vocabulary.hpp"

namespace stormproof::fsm::composition {

/// The time, ns. Untimed worlds say 0.
struct Now : Amount {};
/// The ends of the pair are on different hosts, so discovery needs it.
struct CrossHost : Answer {};

// DATA.
struct Carries : DescriptorField {};  ///< the descriptor is in it
struct CarriesHeartbeat : PacketField {};
struct IsRepair : PacketField {};
// HEARTBEAT, also one that rides in DATA.
struct Announces : DescriptorField {};  ///< it says that the descriptor exists
// ACKNACK.
struct Listed : DescriptorField {};     ///< the bitmap asks for the descriptor
struct BelowBase : DescriptorField {};  ///< every descriptor that it asks for has a higher number
struct IsInitial : PacketField {};

}  // namespace stormproof::fsm::composition
