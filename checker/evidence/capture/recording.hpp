// Records what passes a network interface into a pcap file, through libpcap. It listens and never
// sends; that takes the right to open a packet socket.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "model/config/tree/result.hpp"
#include "model/units.hpp"

namespace stormproof::capture {

struct Recording {
  std::string interface;        ///< "wlan0", "any"
  model::Nanoseconds duration;  ///< how long
  std::string path;             ///< the pcap file, with times in nanoseconds where they are known
  /// A ring: when the file has half of that, it becomes `path`.1 in place of an older one, and a
  /// new one begins.
  std::uint64_t most_bytes = UINT64_MAX;

  [[nodiscard]] std::string older() const { return path + ".1"; }
};

/// Number of UDP packets and fragments recorded. `progress` is called several times a second, when
/// all of them are in the file; false ends the recording, which is then complete up to there.
/// Errors: no such interface, no right to capture (and how to get it), a file that cannot be
/// written.
[[nodiscard]] model::config::Result<std::uint64_t> record(
    const Recording& recording, const std::function<bool(std::uint64_t packets)>& progress);

}  // namespace stormproof::capture
