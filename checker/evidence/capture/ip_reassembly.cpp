// Reassembly as RFC 5722 wants it: a fragment that overlaps another one makes the whole datagram
// void, unless it is an exact copy.
#include "checker/evidence/capture/ip_reassembly.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/core.h>

namespace stormproof::capture {

namespace {

constexpr std::uint8_t udp_protocol = 17;
constexpr std::size_t largest_datagram = 65535;
/// What keeping a fragment takes beside its bytes, so that many tiny ones are not for free.
constexpr std::size_t cost_of_fragment = 128;
constexpr const char* incomplete = "datagrams of which IP fragments are missing";

}  // namespace

std::size_t IpReassembly::cost(const Unfinished& datagram) {
  return datagram.received + datagram.fragments.size() * cost_of_fragment;
}

std::optional<Datagram> IpReassembly::add(const Packet& packet, Bytes bytes) {
  const auto ip = parse_ip(bytes);
  const bool is_cut_by_capture = packet.bytes.size() < packet.original_length;
  if (is_cut_by_capture && (!ip || ip->is_cut)) {
    remark("IP packets cut short by the capture (its snap length)", packet.number);
    return std::nullopt;
  }
  if (!ip || (ip->protocol != udp_protocol && !ip->is_cut)) return std::nullopt;
  if (ip->is_cut) {
    remark("IP packets that are longer than their frames", packet.number);
    return std::nullopt;
  }
  if (ip->is_fragment()) return add_fragment(packet, *ip);
  auto datagram = udp(packet, *ip, ip->payload);
  if (!datagram) return std::nullopt;
  datagram->frames = 1;
  datagram->wire_bytes = packet.original_length;
  return datagram;
}

std::optional<Datagram> IpReassembly::add_fragment(const Packet& packet, const IpPacket& ip) {
  make_room(packet.time_ns);
  const Key key{ip.source, ip.destination, ip.id, ip.protocol};
  auto found = by_key_.find(key);
  if (found == by_key_.end()) {
    waiting_.push_back({.key = key, .started_ns = packet.time_ns, .first_packet = packet.number});
    found = by_key_.emplace(key, std::prev(waiting_.end())).first;
  }
  const auto waiting = found->second;
  ++waiting->frames;
  waiting->wire_bytes += packet.original_length;
  if (const char* error = insert(*waiting, ip)) {
    drop(waiting, error, packet.number);
    return std::nullopt;
  }
  if (waiting->received != waiting->total) return std::nullopt;
  whole_.clear();
  for (const auto& [offset, bytes] : waiting->fragments) {
    whole_.insert(whole_.end(), bytes.begin(), bytes.end());
  }
  auto datagram = udp(packet, ip, whole_);
  if (datagram) {
    datagram->frames = waiting->frames;
    datagram->wire_bytes = waiting->wire_bytes;
  }
  waiting_bytes_ -= cost(*waiting);
  by_key_.erase(found);
  waiting_.erase(waiting);
  return datagram;
}

const char* IpReassembly::insert(Unfinished& datagram, const IpPacket& ip) {
  constexpr const char* impossible = "IP fragments with impossible lengths";
  constexpr const char* overlap = "datagrams whose IP fragments overlap";
  const std::size_t length = ip.payload.size();
  const std::size_t end = ip.offset + length;
  if (length == 0 || end > largest_datagram || (ip.more && length % 8 != 0)) return impossible;
  auto& fragments = datagram.fragments;
  const auto next = fragments.lower_bound(ip.offset);
  if (next != fragments.end() && next->first == ip.offset &&
      std::ranges::equal(next->second, ip.payload)) {
    return nullptr;  // the same packet once more
  }
  if (next != fragments.end() && next->first < end) return overlap;
  if (next != fragments.begin()) {
    const auto& [offset, bytes] = *std::prev(next);
    if (offset + bytes.size() > ip.offset) return overlap;
  }
  if (!ip.more) {
    if (datagram.total) return impossible;
    datagram.total = end;
  }
  const auto last = fragments.empty() ? 0 : fragments.rbegin()->first;
  if (datagram.total && (end > *datagram.total || last >= *datagram.total)) return impossible;
  fragments.emplace(ip.offset, std::vector<std::uint8_t>{ip.payload.begin(), ip.payload.end()});
  datagram.received += length;
  waiting_bytes_ += length + cost_of_fragment;
  return nullptr;
}

std::optional<Datagram> IpReassembly::udp(const Packet& packet, const IpPacket& ip, Bytes bytes) {
  constexpr std::size_t udp_header = 8;
  Cursor cursor{bytes};
  const std::uint16_t source_port = cursor.u16();
  const std::uint16_t destination_port = cursor.u16();
  const std::size_t length = cursor.u16();
  if (bytes.size() < udp_header || length < udp_header || length > bytes.size()) {
    remark("UDP datagrams with an impossible length", packet.number);
    return std::nullopt;
  }
  Datagram datagram;
  datagram.time_ns = packet.time_ns;
  datagram.packet = packet.number;
  datagram.ip_id = ip.id;
  datagram.time_to_live = ip.time_to_live;
  datagram.source = {ip.source, source_port};
  datagram.destination = {ip.destination, destination_port};
  datagram.payload = part(bytes, udp_header, length - udp_header);
  return datagram;
}

void IpReassembly::make_room(std::int64_t now_ns) {
  while (!waiting_.empty()) {
    const Unfinished& oldest = waiting_.front();
    const bool too_old = now_ns - oldest.started_ns > limits_.timeout_ns;
    const bool too_much = waiting_.size() >= limits_.datagrams || waiting_bytes_ >= limits_.bytes;
    if (!too_old && !too_much) return;
    drop(waiting_.begin(), incomplete, oldest.first_packet);
  }
}

void IpReassembly::drop(Waiting::iterator datagram, const char* why, std::uint64_t packet) {
  remark(why, packet);
  waiting_bytes_ -= cost(*datagram);
  by_key_.erase(datagram->key);
  waiting_.erase(datagram);
}

void IpReassembly::finish() {
  while (!waiting_.empty()) drop(waiting_.begin(), incomplete, waiting_.front().first_packet);
}

void IpReassembly::remark(const char* what, std::uint64_t packet) {
  remarks_.add(what, fmt::format("{}, packet {}", file_, packet));
}

}  // namespace stormproof::capture
