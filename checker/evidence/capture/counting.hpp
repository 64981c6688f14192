// The paper's trace processing on a conversation: message counts by class, initial and repair DATA
// by their keys, kinds of HEARTBEATs and ACKNACKs, and the check that every required descriptor key
// is there.
//
// * SEDP DATA has the key (source GUID prefix, destination GUID prefix, writer entity, sequence
//   number); its first occurrence is initial DATA, the others are repairs. Multicast DATA without
//   INFO_DST has no destination, which is a value of its own.
// * HEARTBEAT and ACKNACK are those of the reliable SEDP endpoints.
// * What a Discovery Server passes on has the key (server, destination, writer, described
// endpoint):
//   it gets a new sequence number each time. Announcements to and from a server are counted apart,
//   as pdp_data, with their HEARTBEATs and ACKNACKs; so are the server's GAPs.
// * DATA of the TypeLookup writers is a class of its own, lookup: in no total. Each copy counts; a
//   sample is one whoever gets it.
// * What goes to a participant on the sender's own host is left out, and told apart, unless all
//   participants are on one host.
// * Everything later than the completion instant is left out.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "checker/evidence/capture/events.hpp"
#include "model/counts.hpp"

namespace stormproof::capture {

/// The heartbeat period of Fast DDS's SEDP writers, a constant of its source code.
inline constexpr std::int64_t fastdds_heartbeat_period_ns = 1'000'000'000;

using model::message_class_count;
using model::MessageClass;

enum class HeartbeatKind : std::uint8_t {
  relation_open,       ///< the first to this reader alone
  reply,               ///< to this reader alone, after its initial ACKNACK that asks for one
  directed_piggyback,  ///< to one reader, in a datagram behind DATA
  directed,            ///< to one reader, for another reason
  fan_out_piggyback,   ///< to all readers, because of DATA that was sent (not periodic)
  fan_out_periodic,    ///< to all readers, by the timer of the writer
  fan_out              ///< to all readers, of a vendor whose timer is not known
};
inline constexpr std::size_t heartbeat_kinds = 7;
[[nodiscard]] const char* name_of(HeartbeatKind kind);

struct HeartbeatFigures {
  std::array<std::uint64_t, heartbeat_kinds> by_kind{};
  std::uint64_t behind_data = 0;  ///< in a datagram behind SEDP DATA
  std::uint64_t no_info_dst = 0;
  std::uint64_t empty = 0;  ///< the writer has nothing
  std::uint64_t final_flag = 0;

  [[nodiscard]] std::uint64_t of(HeartbeatKind kind) const {
    return by_kind[static_cast<std::size_t>(kind)];
  }
};

struct AcknackFigures {
  std::uint64_t initial = 0;     ///< asks for nothing, acknowledges nothing
  std::uint64_t negative = 0;    ///< asks for something
  std::uint64_t positive = 0;    ///< only acknowledges
  std::uint64_t preemptive = 0;  ///< initial, and not final: asks for a HEARTBEAT
  std::uint64_t final_flag = 0;
  std::uint64_t requested = 0;  ///< sequence numbers asked for
};

/// Submessages of one kind of traffic, whatever class they are in.
struct TrafficFigures {
  std::uint64_t data = 0;
  std::uint64_t data_frag = 0;
  std::uint64_t heartbeat = 0;
  std::uint64_t acknack = 0;
  std::uint64_t gap = 0;
  std::uint64_t bytes = 0;  ///< of the submessages
};

/// Of one of the two TypeLookup writers of all participants, between hosts.
struct LookupFigures {
  std::uint64_t data = 0;     ///< to each receiver
  std::uint64_t samples = 0;  ///< different ones
  std::uint64_t heartbeat = 0;
  std::uint64_t acknack = 0;
  std::uint64_t gap = 0;
  std::uint64_t data_bytes = 0;  ///< of the DATA submessages

  [[nodiscard]] std::uint64_t messages() const { return data + heartbeat + acknack + gap; }
};

/// Sizes of one class.
struct SizeFigures {
  std::uint64_t submessage_bytes = 0;
  /// UDP payloads of the datagrams in which the class has exactly one submessage, by size.
  std::map<std::uint32_t, std::uint64_t> single{};
};

/// A descriptor key that was not seen: this DATA never went from source to destination.
struct MissingKey {
  GuidPrefix source{};
  GuidPrefix destination{};
  EntityId writer = 0;
  std::int64_t sequence_number = 0;

  auto operator<=>(const MissingKey&) const = default;
};

inline constexpr std::size_t most_missing_listed = 10'000;

struct Counting {
  std::int64_t until_ns = 0;  ///< inclusive
  model::Counts counts{};
  model::Counts same_host{};  ///< what was left out because it stays on one host
  HeartbeatFigures heartbeats{};
  AcknackFigures acknacks{};
  std::array<TrafficFigures, all_traffic.size()> traffic{};  ///< in the order of `all_traffic`
  LookupFigures lookup_requests{};
  LookupFigures lookup_replies{};
  std::uint64_t lookup_datagrams = 0;            ///< with nothing else than these
  std::optional<std::int64_t> last_lookup_ns{};  ///< when the last DATA of either was sent
  std::array<SizeFigures, message_class_count> sizes{};
  std::map<std::uint32_t, std::uint64_t> data_per_datagram{};  ///< datagrams by their SEDP DATA
  std::uint64_t datagrams = 0;
  std::uint64_t frames = 0;
  std::uint64_t wire_bytes = 0;
  std::uint64_t statistics_bytes = 0;     ///< of submessages of Fast DDS that only count
  std::uint64_t multicast_data = 0;       ///< SEDP DATA without a destination, by multicast
  std::uint64_t unknown_destination = 0;  ///< unicast to an address that nobody announced
  std::uint64_t after_cut = 0;            ///< datagrams later than `until_ns`
  std::uint64_t required = 0;             ///< descriptor keys
  std::uint64_t missing_count = 0;        ///< of these, those that were not seen
  std::vector<MissingKey> missing{};      ///< the first of them, at most `most_missing_listed`
  /// When the last required key was sent for the first time; nothing while keys are missing.
  std::optional<std::int64_t> last_initial_ns{};
  /// Announcements, HEARTBEATs and ACKNACKs between a Discovery Server and clients on other hosts,
  /// by event index, ascending: they are in no class.
  std::vector<std::size_t> of_server{};

  /// Questions about types and their answers, to each receiver, with HEARTBEATs, ACKNACKs and GAPs.
  [[nodiscard]] std::uint64_t lookup_messages() const {
    return lookup_requests.messages() + lookup_replies.messages();
  }
  /// Of each event before the cut; nothing if it is in no count.
  std::vector<std::optional<MessageClass>> classes{};
  /// Kind of each SEDP HEARTBEAT, with its event index, in their order.
  std::vector<std::pair<std::size_t, HeartbeatKind>> kinds{};
};

[[nodiscard]] Counting count(const Conversation& conversation, std::int64_t until_ns);

}  // namespace stormproof::capture
