// The two tables. What a user of Fast DDS cannot change is a constant or a rule in the source of
// v2.6.11; in Cyclone DDS 0.10 the timers are settings and the rules are not.
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
    {"spdp.period", "rtps/builtin/discovery_config/leaseAnnouncement",
     "has to be less than leaseDuration, 20 s", 100 * ms, 10 * second},
    {"spdp.startup_announcements", "rtps/builtin/discovery_config/initialAnnouncements/count",
     "after the first one", 0, 100},
    {"spdp.startup_period", "rtps/builtin/discovery_config/initialAnnouncements/period",
     "acts only if there are startup announcements", ms, 10 * second},
    {"spdp.resend", "", "rule of the library, PDPSimple.cpp:684-687"},
    {"spdp.payload_bytes", "", "what an announcement says, ParticipantProxyData.cpp:156-234"},
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
    {"implementation", "", "Cyclone DDS is described with the rules of the paper's model"},
    {"spdp.period", "Discovery/SPDPInterval",
     "LeaseDuration has to be at least 2 s longer, and is raised with it", 100 * ms, 60 * second},
    {"spdp.startup_announcements", "", "rule of the library, q_xevent.c:1038-1063"},
    {"spdp.startup_period", "", "constant in the library, ddsi_participant.c:963-978"},
    {"spdp.resend", "", "rule of the library, q_ddsi_discovery.c:613-636"},
    {"spdp.payload_bytes", "", "what an announcement says"},
    {"sedp.heartbeat_period", "Internal/HeartbeatInterval",
     "not below minsched, 20 ms; acts on user data, too", 20 * ms, 8 * second},
    {"sedp.heartbeat_response_delay", "", "rule of the library, ddsi_acknack.c:295-304"},
    {"sedp.nack_response_delay", "", "rule of the library, q_receive.c:1002-1124"},
    {"sedp.nack_suppression_duration", "Internal/NackDelay",
     "there it is the reader that waits; acts on user data, too", 0, 10 * second},
    {"sedp.initial_acknack_delay", "Internal/PreEmptiveAckDelay", "acts on user data, too", ms,
     10 * second},
    {"sedp.initial_acknack_interval", "",
     "the library goes on with intervals of its own, q_xevent.c:808-869"},
    {"sedp.relation_opening", "", "rule of the library, ddsi_entity_match.c:745-768"},
    {"sedp.initial_data", "", "rule of the library, ddsi_entity_match.c:745-768"},
    {"sedp.unmatched", "", "rule of the library, q_receive.c:1269-1273"},
    {"sedp.initial_acknack", "", "rule of the library, q_receive.c:939-962"},
    {"sedp.acknowledge", "", "rule of the library, q_receive.c:939-1124"},
    {"sedp.heartbeat_timer", "", "rule of the library, q_transmit.c:83-130"},
    {"sedp.heartbeat_recipients", "", "rule of the library, q_transmit.c:152-225"},
    {"sedp.heartbeat_policy", "", "the library doubles its period, which the model has not"},
    {"sedp.adaptive.min_period", "", no_policy},
    {"sedp.adaptive.max_period", "", no_policy},
    {"sedp.adaptive.epsilon", "", no_policy},
    {"sedp.grouping", "", "rule of the library"},
    {"sedp.grouping_limit_bytes", "General/MaxRexmitMessageSize", "acts on user data, too", 1'192,
     14'720},
    {"sedp.piggyback", "", "rule of the library, q_transmit.c:280-321"},
    {"sedp.piggyback_threshold_bytes", "", "the library goes by time, q_transmit.c:280-321"},
    {"sedp.heartbeat_bytes", "", rtps},
    {"sedp.acknack_bytes", "", rtps},
    {"sedp.piggyback_heartbeat_bytes", "", rtps},
    {"sedp.shared_header_bytes", "", rtps},
    {"descriptors.default_publications", "", ros},
    {"descriptors.default_subscriptions", "", ros},
    {"descriptors.default_bytes", "", descriptor},
    {"descriptors.user_bytes", "", descriptor},
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
