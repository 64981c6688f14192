// The two tables. What a user of Fast DDS cannot change is a constant or a rule in the source of
// v2.6.11; in Cyclone DDS 0.10 most timers are settings and the rules are not.
#include "model/config/vendor/vendor_knobs.hpp"

namespace stormproof::model::config::vendor {
namespace {

constexpr std::int64_t ms = 1'000'000;
constexpr std::int64_t second = 1'000 * ms;

constexpr std::string_view no_policy = "the library has no response-aware HEARTBEAT policy";
constexpr std::string_view rtps = "fixed by the RTPS protocol";
constexpr std::string_view ros = "the endpoints of a ROS 2 node";
constexpr std::string_view descriptor = "what a descriptor says: names, types and QoS";

constexpr VendorKnob fastdds_knobs[] = {
    {"implementation", "", "the library's own writer"},
    {"discovery", "rtps/builtin/discovery_config/discoveryProtocol",
     "CLIENT or SUPER_CLIENT of a server, or SIMPLE with an initialPeersList"},
    {"client_sync_period", "rtps/builtin/discovery_config/clientAnnouncementPeriod",
     "acts on clients of a Discovery Server", 20 * ms, 10 * second},
    {"server_routine_period",
     "rtps/builtin/discovery_config/clientAnnouncementPeriod of the server",
     "in the profile of the Discovery Server itself", 20 * ms, 10 * second},
    {"pdp_heartbeat_period", "", "constant in the library, PDP.cpp:73-77"},
    {"pdp_nack_response_delay", "", "constant in the library, PDP.cpp:73-77"},
    {"pdp_nack_suppression_duration", "", "constant in the library, PDP.cpp:73-77"},
    {"pdp_heartbeat_response_delay", "", "constant in the library, PDP.cpp:73-77"},
    {"relay", "", "rule of the library, DiscoveryDataBase::process_dirty_topics"},
    {"server_known", "", "rule of the library, PDPClient::announceParticipantState"},
    {"rejoin", "", "rule of the library, DiscoveryDataBase::create_participant_from_change_"},
    {"peer_ports", "transport_descriptors/transport_descriptor/maxInitialPeersRange",
     "acts with initial peers only; whoever has no port among them may not be found", 1, 100},
    {"max_participants_per_host", "rtps/builtin/mutation_tries",
     "so many ports are tried after the first"},
    {"match_order", "", "rule of the library, PDPSimple::assign_low_level_remote_endpoints"},
    {"builtin_response_delay", "",
     "constant in the library, PDP::create_builtin_reader_attributes"},
    {"type_lookup", "rtps/propertiesPolicy/properties/property[fastdds.type_propagation]",
     "since 3.0; disabled and registration_only switch it off"},
    {"sizes", "", "what an announcement and a descriptor say"},
    {"statistics_bytes", "", "whether the library was built with the statistics module"},
    {"max_data_per_message", "", "constant in the library, RTPSMessageGroup"},
    {"spdp.period", "rtps/builtin/discovery_config/leaseAnnouncement",
     "has to be less than leaseDuration, 20 s", 100 * ms, 10 * second},
    {"spdp.startup_announcements", "rtps/builtin/discovery_config/initialAnnouncements/count",
     "after the first one", 0, 100},
    {"spdp.startup_period", "rtps/builtin/discovery_config/initialAnnouncements/period",
     "acts only if there are startup announcements", ms, 10 * second},
    {"spdp.resend", "", "rule of the library, PDPSimple.cpp:684-687"},
    {"spdp.payload_bytes", "", "what an announcement says, ParticipantProxyData.cpp:156-234"},
    {"spdp.lease", "rtps/builtin/discovery_config/leaseDuration",
     "has to be more than leaseAnnouncement"},
    {"sedp.heartbeat_period", "", "constant in the library, EDPSimple.cpp:54"},
    {"sedp.heartbeat_response_delay", "", "constant in the library, EDPSimple.cpp:57"},
    {"sedp.nack_response_delay", "", "constant in the library, EDPSimple.cpp:55"},
    {"sedp.nack_suppression_duration", "", "constant in the library, EDPSimple.cpp:56"},
    {"sedp.initial_acknack_delay", "",
     "default that SEDP does not override, ReaderAttributes.h:41-45 and EDPSimple.cpp:382-389"},
    {"sedp.initial_acknack_interval", "", "rule of the library, WriterProxy.cpp:539-549"},
    {"sedp.relation_opening", "", "rule of the library, EDPSimple.cpp:760-793"},
    {"sedp.initial_data", "", "rule of the library, StatefulWriter.cpp:1152-1156"},
    {"sedp.unmatched", "", "rule of the library, StatefulReader.cpp:860-885"},
    {"sedp.initial_acknack", "", "rule of the library, StatefulWriter.cpp:1928-1943"},
    {"sedp.acknowledge", "", "rule of the library, StatefulWriter.cpp:1910"},
    {"sedp.heartbeat_timer", "", "rule of the library, TimedEventImpl.cpp:40-51"},
    {"sedp.heartbeat_recipients", "", "rule of the library, StatefulWriter.cpp:573-611"},
    {"sedp.heartbeat_policy", "", no_policy},
    {"sedp.adaptive.min_period", "", no_policy},
    {"sedp.adaptive.max_period", "", no_policy},
    {"sedp.adaptive.epsilon", "", no_policy},
    {"sedp.grouping", "", "rule of the library, RTPSMessageGroup.cpp:332-371"},
    {"sedp.grouping_limit_bytes",
     "rtps/propertiesPolicy/properties/property[fastdds.max_message_size]",
     "maxMessageSize of the transports bounds it, too", 1'400, 65'500},
    {"sedp.piggyback", "", "rule of the library, StatefulWriter.cpp:775,854,1832-1835"},
    {"sedp.piggyback_threshold_bytes", "transport_descriptors/transport_descriptor/sendBufferSize",
     "the writer takes its threshold from the send buffer; net.core.wmem_max of Linux has "
     "to allow it",
     65'507, 67'108'864},
    {"sedp.heartbeat_bytes", "", rtps},
    {"sedp.acknack_bytes", "", rtps},
    {"sedp.piggyback_heartbeat_bytes", "", rtps},
    {"sedp.shared_header_bytes", "", rtps},
    {"descriptors.default_publications", "", ros},
    {"descriptors.default_subscriptions", "", ros},
    {"descriptors.default_bytes", "", descriptor},
    {"descriptors.user_bytes", "", descriptor},
};

constexpr VendorKnob cyclonedds_knobs[] = {
    {"implementation", "", "the library's own rules"},
    {"max_participants_per_host", "Discovery/MaxAutoParticipantIndex",
     "acts with ParticipantIndex auto"},
    {"allow_multicast", "General/AllowMulticast", "acts on user data, too"},
    {"spdp.period", "Discovery/SPDPInterval",
     "LeaseDuration has to be at least 2 s longer, and is raised with it", 100 * ms, 60 * second},
    {"spdp.startup_period", "", "constant in the library, ddsi_participant.c:963-978"},
    {"spdp.directed_replies", "", "constant in the library, q_ddsi_discovery.c:613-636"},
    {"spdp.directed_reply_interval", "", "constant in the library, q_xevent.c:1022-1037"},
    {"spdp.initial_prune_delay", "Discovery/InitialLocatorPruneDelay",
     "of 11; acts on peers at which nobody is known", second, 600 * second},
    {"spdp.discovered_prune_delay", "Discovery/DiscoveredLocatorPruneDelay",
     "of 11; acts on participants that were forgotten", second, 600 * second},
    {"spdp.lease", "Discovery/LeaseDuration", "announcements go out 2 s before it ends"},
    {"sedp.heartbeat_interval", "Internal/HeartbeatInterval",
     "not below minsched, 20 ms; acts on user data, too", 20 * ms, 8 * second},
    {"sedp.heartbeat_interval_max", "Internal/HeartbeatInterval[@max]", "acts on user data, too",
     second, 60 * second},
    {"sedp.match_heartbeat_delay", "", "constant in the library, ddsi_entity_match.c:745-768"},
    {"sedp.ack_delay", "Internal/AckDelay", "acts on user data, too", 0, second},
    {"sedp.nack_delay", "Internal/NackDelay", "acts on user data, too", 0, 10 * second},
    {"sedp.auto_resched_nack_delay", "Internal/AutoReschedNackDelay", "acts on user data, too",
     100 * ms, 60 * second},
    {"sedp.preemptive_ack_delay", "Internal/PreEmptiveAckDelay", "acts on user data, too", ms,
     10 * second},
    {"sedp.max_message_size", "General/MaxMessageSize", "acts on user data, too", 1'192, 65'000},
    {"sedp.max_rexmit_message_size", "General/MaxRexmitMessageSize", "acts on user data, too",
     1'192, 65'000},
    {"sedp.max_queued_rexmit_messages", "Internal/MaxQueuedRexmitMessages",
     "acts on user data, too", 1, 10'000},
    {"sedp.merge_queued_rexmit", "", "rule of the library, q_xmsg.c:808-890"},
    {"sedp.notification", "", "rule of the library, q_receive.c:1309-1320"},
};

}  // namespace

std::span<const VendorKnob> vendor_knobs(Vendor vendor) {
  if (vendor == Vendor::fastdds) return fastdds_knobs;
  return cyclonedds_knobs;
}

std::optional<Vendor> vendor_of_preset(std::string_view preset) {
  if (preset.starts_with("fastdds-")) return Vendor::fastdds;
  if (preset.starts_with("cyclonedds-")) return Vendor::cyclonedds;
  return std::nullopt;
}

}  // namespace stormproof::model::config::vendor
