// UDP datagrams from IP packets: fragments in any order are put together, and what a hostile
// capture can do with offsets and lengths costs bounded memory and ends in a remark.
#pragma once

#include <cstdint>
#include <list>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "checker/evidence/capture/address.hpp"
#include "checker/evidence/capture/capture_file.hpp"
#include "checker/evidence/capture/ip_packet.hpp"
#include "checker/evidence/capture/remarks.hpp"

namespace stormproof::capture {

/// A complete UDP datagram. Its time is that of the packet that completed it.
struct Datagram {
  std::int64_t time_ns = 0;
  std::uint64_t packet = 0;      ///< number of the packet that completed it
  std::uint32_t frames = 0;      ///< packets it came in
  std::uint64_t wire_bytes = 0;  ///< of all its frames, with link headers
  std::uint32_t ip_id = 0;
  std::uint8_t time_to_live = 0;
  UdpEnd source{};
  UdpEnd destination{};
  Bytes payload{};  ///< valid until the next packet
};

class IpReassembly {
 public:
  /// What unfinished datagrams may take up; the oldest make room for new ones.
  struct Limits {
    std::size_t datagrams = 1024;
    std::size_t bytes = 16U << 20U;
    /// Fragments wait this long for the others, in capture time (as Linux does: 30 s).
    std::int64_t timeout_ns = 30'000'000'000;
  };

  /// `file` is for remarks.
  IpReassembly(std::string file, Remarks& remarks) : IpReassembly{std::move(file), remarks, {}} {}
  IpReassembly(std::string file, Remarks& remarks, Limits limits)
      : file_{std::move(file)}, remarks_{remarks}, limits_{limits} {}

  /// The datagram that this IP packet is or completes, if it does and if it is UDP.
  [[nodiscard]] std::optional<Datagram> add(const Packet& packet, Bytes ip);
  /// Reports the datagrams that are still unfinished.
  void finish();

  /// Memory of the fragments that wait, in bytes.
  [[nodiscard]] std::size_t waiting_bytes() const { return waiting_bytes_; }

 private:
  using Key = std::tuple<Address, Address, std::uint32_t, std::uint8_t>;
  struct Unfinished {
    Key key;
    std::int64_t started_ns = 0;
    std::uint64_t first_packet = 0;
    std::uint32_t frames = 0;
    std::uint64_t wire_bytes = 0;
    std::map<std::size_t, std::vector<std::uint8_t>> fragments{};  ///< by offset
    std::size_t received = 0;
    std::optional<std::size_t> total{};
  };
  using Waiting = std::list<Unfinished>;

  [[nodiscard]] std::optional<Datagram> add_fragment(const Packet& packet, const IpPacket& ip);
  [[nodiscard]] std::optional<Datagram> udp(const Packet& packet, const IpPacket& ip, Bytes bytes);
  [[nodiscard]] static std::size_t cost(const Unfinished& datagram);
  [[nodiscard]] const char* insert(Unfinished& datagram, const IpPacket& ip);
  void make_room(std::int64_t now_ns);
  void drop(Waiting::iterator datagram, const char* why, std::uint64_t packet);
  void remark(const char* what, std::uint64_t packet);

  std::string file_;
  Remarks& remarks_;
  Limits limits_;
  Waiting waiting_;  ///< in the order of their first fragments
  std::map<Key, Waiting::iterator> by_key_;
  std::size_t waiting_bytes_ = 0;
  std::vector<std::uint8_t> whole_;  ///< the datagram returned last
};

}  // namespace stormproof::capture
