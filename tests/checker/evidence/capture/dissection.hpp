// What tshark, an independent dissector, says about a capture: every datagram with an RTPS message,
// with its submessages in words that the project's own parser can be compared with.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "checker/evidence/capture/bytes.hpp"
#include "checker/evidence/capture/identifiers.hpp"

namespace stormproof::capture::testing {

/// A submessage with a writer (DATA, DATA_FRAG, HEARTBEAT, ACKNACK, GAP).
struct DissectedSubmessage {
  std::string source{};       ///< GUID prefix in hexadecimal digits, of the header or of INFO_SRC
  std::string destination{};  ///< the same of INFO_DST; empty: none
  unsigned id = 0;
  unsigned flags = 0;
  std::uint32_t bytes = 0;  ///< with its header
  std::string reader{};     ///< "0x000003c7"
  std::string writer{};
  std::vector<std::int64_t> numbers{};  ///< DATA: one; HEARTBEAT: first, last; ACKNACK: base;
                                        ///< GAP: start, base
  std::uint32_t num_bits = 0;
  std::string bits{};  ///< "1101…", a digit for each of them
  std::uint32_t count = 0;

  /// DATA or DATA_FRAG of a user's topic, which is no event.
  [[nodiscard]] bool is_user_data() const {
    return (id == 0x15 || id == 0x16) &&
           traffic_of(static_cast<EntityId>(std::stoul(writer, nullptr, 16))) == Traffic::user;
  }

  bool operator==(const DissectedSubmessage&) const = default;
};

struct DissectedDatagram {
  std::string from{};  ///< source address
  std::string to{};    ///< destination address
  std::string port{};  ///< destination port
  std::uint32_t payload_bytes = 0;
  std::uint32_t frames = 0;      ///< fragments it came in
  std::uint64_t wire_bytes = 0;  ///< of all of them, with link headers
  std::uint32_t info_dst = 0;    ///< submessages
  std::vector<DissectedSubmessage> submessages{};
  std::uint32_t user_data = 0;  ///< submessages that are not among these

  [[nodiscard]] bool is_multicast() const { return to.starts_with("239."); }
};

[[nodiscard]] bool tshark_is_available();

/// By the number of the frame that completes the datagram.
using Dissection = std::map<std::uint64_t, DissectedDatagram>;

/// `capture` is a plain pcap file. Fails the test if tshark fails.
[[nodiscard]] Dissection dissect(Bytes capture);

}  // namespace stormproof::capture::testing
