// What a host is beside its participants: how it is attached to the network, how it saves power,
// how fast its programs handle what they receive, send and have to do in time
// (specs/guide/fleet.md). Pure data. A deployment that lists no hosts has stations of one access
// point with the rates of the wireless profile, always awake, whose programs take no time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "model/dds_profile.hpp"
#include "model/shared_value.hpp"
#include "model/units.hpp"

namespace stormproof::model {

/// A station of an access point, or a host on the cable behind all access points.
enum class Link : std::uint8_t { wireless, wired };

/// A station that sleeps between beacons: what the access point has for it waits for one.
struct PowerSave {
  Nanoseconds beacon_interval{102'400'000};  ///< ≥ 1
  std::uint32_t dtim = 1;                    ///< multicast follows each so-manieth beacon, ≥ 1

  bool operator==(const PowerSave&) const = default;
};

/// What programs need of a host: a participant's only thread of one of its cores, and the time that
/// passes between its first announcement and its first reception. Each ≥ 0.
struct Processor {
  std::uint32_t cores = 1;      ///< threads that run at the same time, ≥ 1
  Nanoseconds reception;        ///< for each datagram that is received
  Nanoseconds emission;         ///< for each datagram that is sent
  Nanoseconds submessage;       ///< for each DATA, HEARTBEAT or ACKNACK in one of them
  Nanoseconds timer;            ///< for whatever else the participant does when it is due
  Nanoseconds deaf_min = {};    ///< range of how long a participant that has started hears nothing
  Nanoseconds deaf_max = {};    ///< ≥ deaf_min
  std::uint64_t deaf_seed = 0;  ///< of the draws

  bool operator==(const Processor&) const = default;
};

struct Host {
  std::string name;
  Link link = Link::wireless;
  std::optional<BitsPerSecond> rate;        ///< of unicast to and from a station
  std::optional<std::string> access_point;  ///< of a station; absent: the first one
  std::optional<PowerSave> power_save;      ///< of a station
  Shared<DdsProfile> dds = {};              ///< of its participants that have none of their own

  bool operator==(const Host&) const = default;
};

/// An access point on the one distribution system. Those on the same channel share its airtime.
struct AccessPoint {
  std::string name;
  std::string channel;

  bool operator==(const AccessPoint&) const = default;
};

}  // namespace stormproof::model
