// The outer layers of a capture file: UDP datagrams in IPv4 packets (fragmented at an MTU of 1500
// bytes, as the link of the model does), Ethernet frames, pcap records with nanoseconds.
#pragma once

#include <cstdint>
#include <functional>
#include <map>

#include "checker/evidence/capture/address.hpp"
#include "checker/evidence/capture/bytes.hpp"

namespace stormproof::capture::write {

/// The most that a UDP datagram of IPv4 carries, in bytes.
inline constexpr std::size_t largest_payload = 65'507;

class PcapWriter {
 public:
  using Sink = std::function<void(Bytes)>;

  /// Writes the header of the file.
  explicit PcapWriter(Sink sink);
  /// One frame for each fragment; `payload` is at most `largest_payload` bytes. `time_ns` ≥ 0,
  /// since 1970.
  void datagram(std::int64_t time_ns, const UdpEnd& source, const UdpEnd& destination,
                Bytes payload);

 private:
  Sink sink_;
  std::map<Address, std::uint16_t> identification_;  ///< of the next packet of each source
};

}  // namespace stormproof::capture::write
