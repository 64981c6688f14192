// The packets of the last moment, by what makes them the same.
#include "checker/evidence/capture/repeated_packets.hpp"

#include <algorithm>
#include <cstdlib>

#include <pcap.h>

#include "checker/evidence/capture/ip_packet.hpp"
#include "checker/evidence/capture/merge.hpp"

namespace stormproof::capture {

namespace {

/// Of what follows the IP header, without the checksum of UDP.
std::uint64_t content_digest(const IpPacket& ip) {
  constexpr std::uint8_t udp = 17;
  constexpr std::size_t checksum_at = 6;
  constexpr std::size_t checksum_size = 2;
  constexpr std::uint64_t odd = 0x9e3779b97f4a7c15;
  if (ip.protocol != udp || ip.offset > 0) return digest_of(ip.payload);
  return digest_of(part(ip.payload, 0, checksum_at)) * odd +
         digest_of(part(ip.payload, checksum_at + checksum_size));
}

}  // namespace

RepeatedPackets::RepeatedPackets(int link_type)
    : is_cooked_{link_type == DLT_LINUX_SLL || link_type == DLT_LINUX_SLL2} {}

bool RepeatedPackets::was_there(std::int64_t time_ns, Bytes frame, Bytes bytes) {
  const auto ip = parse_ip(bytes);
  if (!ip) return false;
  forget(time_ns);
  const Key key{ip->source, ip->destination, ip->id, ip->offset, ip->more, content_digest(*ip)};
  const std::uint64_t link = digest_of(part(frame, 0, frame.size() - bytes.size()));
  const auto [first, last] = known_.equal_range(key);
  const bool again = std::any_of(first, last, [&](const Known::value_type& entry) {
    const Seen& seen = entry.second;
    const std::int64_t apart = std::abs(time_ns - seen.time_ns);
    if (ip->id != 0) return apart <= apart_ns;
    return apart <= apart_unidentified_ns && (is_cooked_ || link != seen.link);
  });
  if (!again) order_.push_back(known_.emplace(key, Seen{time_ns, link}));
  return again;
}

void RepeatedPackets::forget(std::int64_t now_ns) {
  while (!order_.empty()) {
    // Captures of several interfaces are not quite in the order of time.
    const bool is_over = std::abs(now_ns - order_.front()->second.time_ns) > apart_ns;
    if (!is_over && order_.size() < most) return;
    known_.erase(order_.front());
    order_.pop_front();
  }
}

}  // namespace stormproof::capture
