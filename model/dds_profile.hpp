// The DDS profile: every protocol knob of the paper's model, with the value of the paper's own
// evaluation as the default. specs/guide/model.md explains each knob;
// `model/config/knobs/dds_knobs.hpp` gives its key, unit and range.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "model/amendments.hpp"
#include "model/units.hpp"

namespace stormproof::model {

/// Whose DDS runs: the paper's, or Fast DDS or Cyclone DDS as their source code has them; and
/// Fast DDS with another way to discover (`DdsProfile::discovery`), and the paper's with amended
/// rules (`DdsProfile::amendments`), which `kind_of` a profile says and no profile names. What is
/// true of each: model/implementations.hpp.
enum class ImplementationKind : std::uint8_t {
  paper,
  fastdds,
  cyclone,
  fastdds_static,
  fastdds_server,
  paper_amended
};

/// How participants of `implementation: fastdds` find each other: by multicast; through a Discovery
/// Server, as clients, which learn what they match, or as super clients, which learn everything;
/// or by unicast to the ports of the hosts that they are told.
enum class Discovery : std::uint8_t { simple, server, super_client, static_peers };
/// Whether a Discovery Server sends again what has not been acknowledged whenever something
/// arrives.
enum class Relay : std::uint8_t { repeat, once };
/// What becomes of a client that a Discovery Server hears of again while it still tells others that
/// the client is gone.
enum class Rejoin : std::uint8_t { dropped, known };
/// What a client knows of a Discovery Server before it hears of it.
enum class ServerKnown : std::uint8_t { guid, locator };

/// What a participant sends when it recognises another one for the first time.
enum class SpdpResend : std::uint8_t { all_known, new_and_multicast, new_only, none };
/// When the writer side opens: with the receiver's recognition, or when each side has seen the
/// other.
enum class RelationOpening : std::uint8_t { receiver, each_side };
/// Whether descriptors that exist when a relation opens are sent at once or only after an ACKNACK.
enum class InitialData : std::uint8_t { push, pull };
/// What a reader side that is not open does with DATA and HEARTBEATs (only with `each_side`).
enum class Unmatched : std::uint8_t { drop, accept };
/// What a writer does with an initial ACKNACK.
enum class InitialAckNackReply : std::uint8_t { bitmap, heartbeat, none };
/// How the delay of an initial ACKNACK grows while no HEARTBEAT is seen.
enum class InitialAckNackInterval : std::uint8_t { doubling, constant };
/// What an ACKNACK confirms: all descriptors outside its bitmap, or only those below the first
/// missing one.
enum class Acknowledge : std::uint8_t { bitmap, prefix };
/// Whether a writer may have more than one periodic HEARTBEAT expiry pending.
enum class HeartbeatTimerKind : std::uint8_t { single, additive };
/// Who receives a periodic HEARTBEAT: readers that lack an acknowledgment, or every open relation.
enum class HeartbeatRecipients : std::uint8_t { unacknowledged, matched };
enum class HeartbeatPolicy : std::uint8_t { periodic, adaptive };
/// How descriptors share packets: RTPS messages up to a limit, one MTU, or one descriptor a packet.
enum class Grouping : std::uint8_t { message, mtu, single };
/// How DATA is charged against the byte threshold of the piggyback HEARTBEAT; `group`, which only
/// `implementation: fastdds` has, counts what the participant has sent, for all its writers.
enum class Piggyback : std::uint8_t { cumulative, linear, off, group };

/// In which order a participant of `implementation: fastdds` opens what it has with one that it
/// recognises: its endpoints, or the built-in ones beside them.
enum class MatchOrder : std::uint8_t { endpoints_first, builtin_first };
/// Which samples of the TypeLookup writers of `implementation: fastdds` go only to the participant
/// that they are for: none, answers, or questions, too.
enum class LookupFilter : std::uint8_t { none, answers, all };
/// What a participant of `implementation: fastdds` asks one question for: a type of a stream, a
/// type, or all types of a participant that wait.
enum class LookupUnit : std::uint8_t { type_and_stream, type, participant };
/// From which version of Fast DDS on announcements and descriptors have their sizes.
enum class SizesSince : std::uint8_t { v2_6, v3_2, v3_6 };

/// What `implementation: cyclone` sends by multicast: all that goes to two readers or more, only
/// announcements, or what the network is good for: all on a wired one, announcements on Wi-Fi. A
/// scenario says which of the first two that is.
enum class AllowMulticast : std::uint8_t { always, spdp, by_network, never };
/// A truth value of a profile.
enum class MergeQueued : std::uint8_t { no, yes };
/// When a reader of `implementation: cyclone` tells a sample: when it has all before it; or, if the
/// sample is newer than what the first HEARTBEAT of its writer announced, when it has all that is
/// as new.
enum class Notification : std::uint8_t { in_order, fresh_at_once };

/// SPDP: the participant announcements.
struct SpdpProfile {
  Nanoseconds period{3'000'000'000};        ///< τ_P
  std::uint32_t startup_announcements = 5;  ///< announcements sent at the startup period
  Nanoseconds startup_period{100'000'000};
  SpdpResend resend = SpdpResend::all_known;
  Bytes payload_bytes{420};
  /// How long others remember a participant of which they hear nothing; absent: nothing is said. It
  /// acts in a life alone (`deployment.life`).
  std::optional<Nanoseconds> lease = {};
  // `implementation: cyclone` only.
  std::uint32_t directed_replies = 4;  ///< to a participant that is recognised
  Nanoseconds directed_reply_interval{1'000'000'000};
  /// How long the address of a peer at which nobody is known is announced to after the start, and
  /// that of a participant after it was forgotten; absent: for ever.
  std::optional<Nanoseconds> initial_prune_delay = {};
  std::optional<Nanoseconds> discovered_prune_delay = {};

  bool operator==(const SpdpProfile&) const = default;
};

/// The response-aware HEARTBEAT policy. The floor ε of the response share is the fraction
/// numerator/denominator.
struct AdaptiveProfile {
  Nanoseconds min_period{100'000'000};
  Nanoseconds max_period{3'000'000'000};
  std::int64_t epsilon_numerator = 1;
  std::int64_t epsilon_denominator = 20;

  bool operator==(const AdaptiveProfile&) const = default;
};

/// SEDP: the reliable exchange of endpoint descriptors.
struct SedpProfile {
  Nanoseconds heartbeat_period{1'000'000'000};    ///< τ_H
  Nanoseconds heartbeat_response_delay{10'000};   ///< τ_A
  Nanoseconds nack_response_delay{100'000};       ///< τ_N
  Nanoseconds nack_suppression_duration{10'000};  ///< τ_S
  Nanoseconds initial_acknack_delay{70'000'000};  ///< τ_I; 0 disables initial ACKNACKs
  InitialAckNackInterval initial_acknack_interval = InitialAckNackInterval::doubling;
  RelationOpening relation_opening = RelationOpening::receiver;
  InitialData initial_data = InitialData::push;
  Unmatched unmatched = Unmatched::drop;
  InitialAckNackReply initial_acknack = InitialAckNackReply::bitmap;
  Acknowledge acknowledge = Acknowledge::bitmap;
  HeartbeatTimerKind heartbeat_timer = HeartbeatTimerKind::single;
  HeartbeatRecipients heartbeat_recipients = HeartbeatRecipients::unacknowledged;
  HeartbeatPolicy heartbeat_policy = HeartbeatPolicy::periodic;
  AdaptiveProfile adaptive;
  Grouping grouping = Grouping::message;
  /// Largest RTPS message: payload limit of `grouping: message`, and of pulled and repair DATA in
  /// `implementation: fastdds`.
  Bytes grouping_limit_bytes{65'500};
  Piggyback piggyback = Piggyback::cumulative;
  Bytes piggyback_threshold_bytes{106'496};
  Bytes heartbeat_bytes{68};            ///< UDP payload of a HEARTBEAT of its own
  Bytes acknack_bytes{64};              ///< UDP payload of an ACKNACK with an empty bitmap
  Bytes piggyback_heartbeat_bytes{32};  ///< what a HEARTBEAT adds to a DATA packet
  Bytes shared_header_bytes{36};        ///< RTPS header and INFO_DST, once per packet

  // `implementation: cyclone` only, by the names of its configuration file.
  Nanoseconds heartbeat_interval{100'000'000};
  Nanoseconds heartbeat_interval_max{8'000'000'000};  ///< which the interval stays below
  Nanoseconds match_heartbeat_delay{1'000'000};
  Nanoseconds ack_delay{10'000'000};    ///< between two ACKNACKs that say the same
  Nanoseconds nack_delay{100'000'000};  ///< between two requests for the same
  Nanoseconds auto_resched_nack_delay{3'000'000'000};
  Nanoseconds preemptive_ack_delay{10'000'000};
  Bytes max_message_size{14'720};        ///< UDP payload
  Bytes max_rexmit_message_size{1'456};  ///< of a packet with a retransmission
  std::uint32_t max_queued_rexmit_messages = 200;
  /// Whether a request for a retransmission that is queued for another reader makes it one to all.
  MergeQueued merge_queued_rexmit = MergeQueued::yes;
  Notification notification = Notification::in_order;

  bool operator==(const SedpProfile&) const = default;
};

/// What `discovery: server` and `super_client` add.
struct ServerProfile {
  Nanoseconds client_sync_period{450'000'000};     ///< τ_T: until a client matches endpoints
  Nanoseconds server_routine_period{450'000'000};  ///< τ_R: until a server looks again
  // Of the participant announcements, which are reliable.
  Nanoseconds pdp_heartbeat_period{350'000'000};
  Nanoseconds pdp_nack_response_delay{100'000'000};
  Nanoseconds pdp_nack_suppression_duration{11'000'000};
  Nanoseconds pdp_heartbeat_response_delay{11'000'000};
  Relay relay = Relay::repeat;
  ServerKnown known = ServerKnown::guid;
  Rejoin rejoin = Rejoin::dropped;

  bool operator==(const ServerProfile&) const = default;
};

/// What later versions of Fast DDS have beside other timers; without it they are those of 2.6.
struct VersionProfile {
  MatchOrder match_order = MatchOrder::endpoints_first;
  /// From a HEARTBEAT of a built-in endpoint beside SEDP to the ACKNACK that answers it (τ_B).
  Nanoseconds builtin_response_delay{5'000'000};
  SizesSince sizes = SizesSince::v2_6;
  Whether type_lookup = Whether::no;  ///< there are endpoints that ask for types, and answer
  /// From what begins it to the HEARTBEAT of a writer of questions or answers (τ_L).
  Nanoseconds typelookup_heartbeat_period{350'000'000};
  LookupFilter typelookup_filter = LookupFilter::none;
  LookupUnit typelookup_unit = LookupUnit::type_and_stream;
  Bytes type_object_bytes{300};     ///< DATA submessage that answers with a type
  Bytes descriptor_extra_bytes{0};  ///< more in each descriptor: what it says of its type; 0: none,
                                    ///< or what it is if endpoints have types (`deployment.types`)
  Bytes statistics_bytes{0};        ///< more in each packet: a submessage of the vendor
  std::uint32_t max_data_per_message = 0;  ///< that a message takes; 0: as many as fit

  bool operator==(const VersionProfile&) const = default;
};

/// How many descriptors a default ROS 2 node has and how large they are (UDP payload of a packet of
/// its own).
struct DescriptorProfile {
  std::uint32_t default_publications = 9;
  std::uint32_t default_subscriptions = 8;
  std::array<Bytes, 2> default_bytes{Bytes{452},
                                     Bytes{532}};  ///< first and last default descriptor
  Bytes user_bytes{460};

  bool operator==(const DescriptorProfile&) const = default;
};

struct DdsProfile {
  ImplementationKind implementation{};  ///< the paper's, if nothing else is said
  SpdpProfile spdp;
  SedpProfile sedp;
  DescriptorProfile descriptors;
  AllowMulticast allow_multicast = AllowMulticast::always;  ///< `implementation: cyclone` only
  /// `implementation: cyclone` only: to how many ports of each host announcements go, beside the
  /// group; 0: to nobody who is not known.
  std::uint32_t peers = 0;
  // `implementation: fastdds` only.
  Discovery discovery = Discovery::simple;
  VersionProfile version;
  ServerProfile server;
  std::uint32_t peer_ports = 4;               ///< of each host, with static peers
  std::optional<Amendments> amendments = {};  ///< `implementation: paper` only
  /// Participants of a host that find a port or an index; 0: as many as the library's own settings
  /// let start (`participants_of_a_host`). Not of `implementation: paper`.
  std::uint32_t max_participants_per_host = 0;
  /// What the described system has and this model has not: the setting, and what it would do. No
  /// run depends on it; every report of a run has to name it as an assumption.
  std::map<std::string, std::string> unmodelled;

  bool operator==(const DdsProfile&) const = default;
};

}  // namespace stormproof::model
