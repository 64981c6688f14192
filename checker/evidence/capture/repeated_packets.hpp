// A capture of several interfaces ("-i any", a bridge, a veth pair) holds a packet once for each
// that it passes. These are one packet, and not repeats: what a sender repeats is a packet of its
// own.
//
// A host gives each packet another identification (RFC 6864 wants that within the lifetime of a
// datagram), so the same addresses, identification and bytes a moment apart are one packet. Time to
// live and checksums do not count: routers and interfaces write them. Without an identification
// (0 where fragments are forbidden, IPv6) a packet is the same if it also passed another
// interface: its link header is another one, or the capture is of all interfaces ("cooked").
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <tuple>

#include "checker/evidence/capture/address.hpp"
#include "checker/evidence/capture/bytes.hpp"

namespace stormproof::capture {

class RepeatedPackets {
 public:
  /// Interfaces of one machine see a packet that soon after each other, in nanoseconds.
  static constexpr std::int64_t apart_ns = 10'000'000;
  /// The same of packets without an identification: a sender may repeat itself soon, too.
  static constexpr std::int64_t apart_unidentified_ns = 1'000'000;
  /// Packets that are remembered, at most.
  static constexpr std::size_t most = 1U << 14U;

  explicit RepeatedPackets(int link_type);

  /// Whether this IP packet, which `frame` ends with, was there before.
  [[nodiscard]] bool was_there(std::int64_t time_ns, Bytes frame, Bytes ip);

 private:
  using Key = std::tuple<Address, Address, std::uint32_t, std::size_t, bool, std::uint64_t>;
  struct Seen {
    std::int64_t time_ns = 0;
    std::uint64_t link = 0;  ///< of its link header
  };
  using Known = std::multimap<Key, Seen>;

  void forget(std::int64_t now_ns);

  bool is_cooked_;
  Known known_;
  std::deque<Known::iterator> order_;
};

}  // namespace stormproof::capture
