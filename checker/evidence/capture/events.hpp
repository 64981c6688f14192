// A capture as the protocol sees it: the discovery submessages in the order in which they were
// sent, each with its source, its destination, and what it says. This is what counting, conformance
// and comparison with a prediction start from; addresses, fragments and byte orders are gone.
//
// The paper's trace processing: source-side captures are merged without counting a datagram twice;
// each contained submessage is an event of its own; a datagram that goes to several participants
// has one event for each unicast copy, because each copy is a datagram in the capture. What robots
// tell each other when they know each other, DATA of their own topics, is most of a long capture
// and nothing of discovery: it is counted with its datagram and is no event.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "checker/evidence/capture/address.hpp"
#include "checker/evidence/capture/discovery_data.hpp"
#include "checker/evidence/capture/identifiers.hpp"
#include "checker/evidence/capture/igmp.hpp"
#include "checker/evidence/capture/remarks.hpp"
#include "checker/evidence/capture/rtps_message.hpp"
#include "checker/evidence/capture/topology.hpp"
#include "model/config/tree/result.hpp"

namespace stormproof::capture {

/// DATA, or the first fragment of one (DATA_FRAG).
struct DataEvent {
  std::int64_t sequence_number = 0;
  std::uint32_t fragment = 0;      ///< 0: DATA; otherwise the number of DATA_FRAG's first fragment
  std::optional<Guid> endpoint{};  ///< SEDP: whom it describes
  bool is_gone = false;            ///< the endpoint is disposed of; SPDP: the participant leaves
  std::optional<GuidPrefix> participant{};  ///< SPDP: whom it announces
};
struct HeartbeatEvent {
  std::int64_t first = 0;
  std::int64_t last = 0;  ///< first − 1: the writer has nothing
  std::uint32_t count = 0;
  bool is_final = false;
  bool is_liveliness = false;

  [[nodiscard]] bool is_empty() const { return last < first; }
};
struct AcknackEvent {
  SequenceNumberSet missing{};  ///< everything below `missing.base` is acknowledged
  std::uint32_t count = 0;
  bool is_final = false;

  /// Asks for nothing and acknowledges nothing: what a reader sends that knows of no sample yet.
  [[nodiscard]] bool is_initial() const { return missing.base <= 1 && missing.size() == 0; }
};
struct GapEvent {
  std::int64_t start = 0;
  SequenceNumberSet list{};
};

/// One submessage of one datagram.
struct Event {
  std::int64_t time_ns = 0;    ///< since 1970, of the capture
  std::uint32_t datagram = 0;  ///< index in Conversation::datagrams
  std::uint32_t bytes = 0;     ///< of the submessage, with its header
  GuidPrefix source{};
  /// From INFO_DST, or from the address and port that a participant announced. Nothing: multicast
  /// without INFO_DST, or an address that no participant announced.
  std::optional<GuidPrefix> destination{};
  bool has_info_dst = false;
  bool is_multicast = false;
  /// Source and destination are on one host, though others exist: not discovery across hosts.
  bool is_same_host = false;
  EntityId reader = 0;
  EntityId writer = 0;  ///< of the relation; an ACKNACK goes *to* it
  std::variant<DataEvent, HeartbeatEvent, AcknackEvent, GapEvent> content{};

  [[nodiscard]] Traffic traffic() const { return traffic_of(writer); }
  [[nodiscard]] const DataEvent* data() const { return std::get_if<DataEvent>(&content); }
  [[nodiscard]] const HeartbeatEvent* heartbeat() const {
    return std::get_if<HeartbeatEvent>(&content);
  }
  [[nodiscard]] const AcknackEvent* acknack() const { return std::get_if<AcknackEvent>(&content); }
  [[nodiscard]] const GapEvent* gap() const { return std::get_if<GapEvent>(&content); }
};

/// Whether a DATA of SEDP describes an endpoint of another participant than its source, as a
/// Discovery Server does.
[[nodiscard]] inline bool is_relayed(const Event& event, const DataEvent& data) {
  return data.endpoint && data.endpoint->prefix != event.source;
}

/// DATA of users' topics in one datagram.
struct UserData {
  std::uint32_t bytes = 0;      ///< of the submessages, with their headers
  std::uint16_t data = 0;       ///< submessages: at most 65,535 bytes of at least 4
  std::uint16_t fragments = 0;  ///< of them, DATA_FRAG
};

/// A datagram with an RTPS message.
struct DatagramRecord {
  std::int64_t time_ns = 0;
  std::uint64_t packet = 0;            ///< the packet that completed it, from 1 on
  std::uint32_t wire_bytes = 0;        ///< of all its frames, with link headers
  std::uint32_t payload_bytes = 0;     ///< of UDP
  std::uint32_t statistics_bytes = 0;  ///< of these, for statistics of the vendor
  UserData user{};
  std::uint16_t capture = 0;  ///< index in Conversation::captures
  std::uint16_t frames = 0;
  VendorId vendor = 0;            ///< of the message's header
  std::uint8_t time_to_live = 0;  ///< as captured; 0: it does not leave its host
  UdpEnd source{};
  UdpEnd destination{};
};

struct CaptureInfo {
  std::string name{};
  std::uint64_t packets = 0;
  std::uint64_t datagrams = 0;  ///< with an RTPS message
  std::uint64_t merged = 0;     ///< of these, known from another capture and left out
  std::map<Address, std::uint64_t> sources{};  ///< where the datagrams came from, merged ones too
  std::map<Address, std::uint64_t> multicast_sources{};  ///< of those to a group
};

struct Conversation {
  std::vector<CaptureInfo> captures{};
  std::deque<DatagramRecord> datagrams{};  ///< in time order
  std::deque<Event> events{};              ///< in time order, then as in the datagram
  Topology topology{};
  TypeLookups lookups{};  ///< what questions about types and answers say
  Igmp igmp{};
  std::vector<Remark> remarks{};
  std::int64_t first_ns = 0;  ///< time of the first packet of all captures
  std::int64_t last_ns = 0;   ///< of the last one
};

/// A capture that is not a file (for tests).
struct MemoryCapture {
  std::string name{};
  Bytes content{};
  std::size_t unpack_limit = 0;            ///< bytes
  std::optional<std::size_t> most_kept{};  ///< bytes of what is read; otherwise as of files
};

/// Called now and then with the number of packets read; false stops reading, and what was read
/// until then is the conversation.
using Progress = std::function<bool(std::uint64_t packets)>;

/// An error if a file cannot be read, or holds no RTPS message at all.
[[nodiscard]] model::config::Result<Conversation> read_conversation(
    std::span<const std::string> files, const Progress& progress = {});
[[nodiscard]] model::config::Result<Conversation> read_conversation(
    std::span<const MemoryCapture> captures);

}  // namespace stormproof::capture
