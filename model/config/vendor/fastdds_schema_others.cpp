// The tables of the Fast DDS XML elements outside of participant profiles: transport descriptors
// (XMLParser.cpp's parseXMLTransportData; defaults from UDPTransportDescriptor.h and
// SharedMemTransportDescriptor.h), user endpoints, and properties.
#include <array>

#include "model/config/vendor/fastdds_schema.hpp"

namespace stormproof::model::config::vendor::fastdds {
namespace {

using enum ValueKind;

constexpr std::string_view tcp_note = "acts on TCP only";

constexpr std::array transport_items{
    SchemaItem{"transport_id", text, "", Effect::none, "its name for <userTransports>"},
    SchemaItem{"type", choice, "", Effect::none, "", "UDPv4|UDPv6|TCPv4|TCPv6|SHM"},
    SchemaItem{"sendBufferSize", uint32, "0", Effect::knob, "", "", oldest_version, udp | tcp},
    SchemaItem{"receiveBufferSize", uint32, "0", Effect::unmodelled,
               "size of the sockets' receive buffers; a receiver of the model never drops what "
               "arrives",
               "", oldest_version, udp | tcp},
    SchemaItem{"TTL", uint8, "1", Effect::none, "a scenario is one network segment", "",
               oldest_version, udp | tcp},
    SchemaItem{"maxMessageSize", uint32, "65500", Effect::knob, ""},
    SchemaItem{"maxInitialPeersRange", uint32, "4", Effect::none,
               "acts with an <initialPeersList> only"},
    SchemaItem{"interfaceWhiteList", addresses, "", Effect::unmodelled,
               "packets leave and arrive only there; the model has one interface a host", "",
               oldest_version, udp | tcp},
    SchemaItem{"non_blocking_send", flag, "false", Effect::unmodelled,
               "what finds the socket's queue full is dropped; in the model it waits", "",
               oldest_version, udp},
    SchemaItem{"output_port", uint16, "0", Effect::none, port_note, "", oldest_version, udp},
    SchemaItem{"wan_addr", text, "", Effect::none, tcp_note, "", oldest_version, tcp},
    SchemaItem{"keep_alive_frequency_ms", int32, "5000", Effect::none, tcp_note, "", oldest_version,
               tcp},
    SchemaItem{"keep_alive_timeout_ms", int32, "15000", Effect::none, tcp_note, "", oldest_version,
               tcp},
    SchemaItem{"max_logical_port", uint16, "100", Effect::none, tcp_note, "", oldest_version, tcp},
    SchemaItem{"logical_port_range", uint16, "20", Effect::none, tcp_note, "", oldest_version, tcp},
    SchemaItem{"logical_port_increment", uint16, "2", Effect::none, tcp_note, "", oldest_version,
               tcp},
    SchemaItem{"listening_ports", opaque, "", Effect::none, tcp_note, "", oldest_version, tcp},
    SchemaItem{"calculate_crc", flag, "true", Effect::none, tcp_note, "", oldest_version, tcp},
    SchemaItem{"check_crc", flag, "true", Effect::none, tcp_note, "", oldest_version, tcp},
    SchemaItem{"enable_tcp_nodelay", flag, "false", Effect::none, tcp_note, "", oldest_version,
               tcp},
    SchemaItem{"tls", opaque, "", Effect::none, tcp_note, "", oldest_version, tcp},
    SchemaItem{"segment_size", uint32, "0", Effect::knob, "", "", oldest_version, shm},
    SchemaItem{"port_queue_capacity", uint32, "512", Effect::none, "acts within a host only", "",
               oldest_version, shm},
    SchemaItem{"healthy_check_timeout_ms", uint32, "1000", Effect::none, "acts within a host only",
               "", oldest_version, shm},
    SchemaItem{"rtps_dump_file", text, "", Effect::none, "writes a log", "", oldest_version, shm},
    SchemaItem{"tcp_negotiation_timeout", uint32, "0", Effect::none, tcp_note, "", 213, tcp},
    SchemaItem{"netmask_filter", text, "AUTO", Effect::unmodelled,
               "packets leave only by interfaces whose network the receiver is in; the model has "
               "one interface a host",
               "", 214, udp | tcp},
    SchemaItem{"interfaces", opaque, "", Effect::unmodelled,
               "packets leave and arrive only there; the model has one interface a host", "", 214,
               udp | tcp},
    SchemaItem{"default_reception_threads", opaque, "", Effect::none, thread_note, "", 213},
    SchemaItem{"reception_threads", opaque, "", Effect::none, thread_note, "", 213},
    SchemaItem{"dump_thread", opaque, "", Effect::none, thread_note, "", 213, shm},
    SchemaItem{"keep_alive_thread", opaque, "", Effect::none, thread_note, "", 213, tcp},
    SchemaItem{"accept_thread", opaque, "", Effect::none, thread_note, "", 213, tcp}};

constexpr std::string_view user_note = "acts on endpoints of user topics only, not on SEDP";

constexpr std::array writer_items{
    SchemaItem{"topic", opaque, "", Effect::none, user_note},
    SchemaItem{"qos", opaque, "", Effect::none, user_note},
    SchemaItem{"times", group, "", Effect::none, user_note},
    SchemaItem{"times/initialHeartbeatDelay", duration, "", Effect::none, user_note},
    SchemaItem{"times/heartbeatPeriod", duration, "", Effect::none, user_note},
    SchemaItem{"times/nackResponseDelay", duration, "", Effect::none, user_note},
    SchemaItem{"times/nackSupressionDuration", duration, "", Effect::none, user_note},
    SchemaItem{"unicastLocatorList", locators, "", Effect::none, user_note},
    SchemaItem{"multicastLocatorList", locators, "", Effect::none, user_note},
    SchemaItem{"remoteLocatorList", locators, "", Effect::none, user_note},
    SchemaItem{"external_unicast_locators", opaque, "", Effect::none, user_note, "", 210},
    SchemaItem{"ignore_non_matching_locators", flag, "false", Effect::none, user_note, "", 210},
    SchemaItem{"throughputController", opaque, "", Effect::none, user_note},
    SchemaItem{"historyMemoryPolicy", choice, "", Effect::none, user_note, history_policies},
    SchemaItem{"propertiesPolicy", properties, "", Effect::none, user_note},
    SchemaItem{"userDefinedID", int32, "", Effect::none, user_note},
    SchemaItem{"entityID", int32, "", Effect::none, user_note},
    SchemaItem{"matchedSubscribersAllocation", opaque, "", Effect::none, user_note}};

constexpr std::array reader_items{
    SchemaItem{"topic", opaque, "", Effect::none, user_note},
    SchemaItem{"qos", opaque, "", Effect::none, user_note},
    SchemaItem{"times", group, "", Effect::none, user_note},
    SchemaItem{"times/initialAcknackDelay", duration, "", Effect::none, user_note},
    SchemaItem{"times/heartbeatResponseDelay", duration, "", Effect::none, user_note},
    SchemaItem{"unicastLocatorList", locators, "", Effect::none, user_note},
    SchemaItem{"multicastLocatorList", locators, "", Effect::none, user_note},
    SchemaItem{"remoteLocatorList", locators, "", Effect::none, user_note},
    SchemaItem{"external_unicast_locators", opaque, "", Effect::none, user_note, "", 210},
    SchemaItem{"ignore_non_matching_locators", flag, "false", Effect::none, user_note, "", 210},
    SchemaItem{"expectsInlineQos", flag, "false", Effect::none, user_note},
    SchemaItem{"historyMemoryPolicy", choice, "", Effect::none, user_note, history_policies},
    SchemaItem{"propertiesPolicy", properties, "", Effect::none, user_note},
    SchemaItem{"userDefinedID", int32, "", Effect::none, user_note},
    SchemaItem{"entityID", int32, "", Effect::none, user_note},
    SchemaItem{"matchedPublishersAllocation", opaque, "", Effect::none, user_note}};

constexpr std::string_view physical_note =
    "makes every announcement longer; those of the model have the size of ROS 2's";

constexpr std::array property_items{
    SchemaItem{"fastdds.max_message_size", uint32, "", Effect::knob, ""},
    SchemaItem{"fastdds.shm.enforce_metatraffic", choice, "none", Effect::unmodelled,
               "participants of one host discover each other through shared memory, too; the model "
               "has only the network",
               "none|unicast|all"},
    SchemaItem{"fastdds.push_mode", flag, "true", Effect::none,
               "acts on writers of user topics only, in their own profile"},
    SchemaItem{"fastdds.type_propagation", choice, "enabled", Effect::knob, "",
               "disabled|enabled|minimal_bandwidth|registration_only", 300},
    SchemaItem{"fastdds.serialize_optional_qos", text, "", Effect::unmodelled,
               "descriptors say QoS that equal the default, too, and are larger than the model's",
               "", 302},
    SchemaItem{"fastdds.statistics", text, "", Effect::unmodelled,
               "adds endpoints for statistics, each with a descriptor; the model has those of a "
               "ROS 2 node"},
    SchemaItem{"fastdds.physical_data.host", text, "", Effect::unmodelled, physical_note},
    SchemaItem{"fastdds.physical_data.user", text, "", Effect::unmodelled, physical_note},
    SchemaItem{"fastdds.physical_data.process", text, "", Effect::unmodelled, physical_note},
    SchemaItem{"fastdds.tcp_transport.non_blocking_send", text, "", Effect::none, tcp_note},
    SchemaItem{"PARTICIPANT_TYPE", text, "", Effect::none, "the library sets it itself"}};

}  // namespace

std::span<const SchemaItem> transport_schema() { return transport_items; }
std::span<const SchemaItem> writer_schema() { return writer_items; }
std::span<const SchemaItem> reader_schema() { return reader_items; }
std::span<const SchemaItem> property_schema() { return property_items; }

}  // namespace stormproof::model::config::vendor::fastdds
