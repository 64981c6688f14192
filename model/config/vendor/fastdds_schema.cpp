// The table of the elements of a Fast DDS participant profile, and the look-up in all tables.
// Evidence is the source of v2.6.11: defaults from RTPSParticipantAttributes.h, what an element
// does from where its attribute is used.
#include "model/config/vendor/fastdds_schema.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include <fmt/core.h>

#include "model/config/vendor/any_case.hpp"

namespace stormproof::model::config::vendor::fastdds {
namespace {

using enum ValueKind;

constexpr std::string_view memory_note =
    "memory of the builtin endpoints; ROS 2 sets its own policy, and no packet depends on it";
constexpr std::string_view allocation_note = "memory that is allocated in advance";
constexpr std::string_view limit_note =
    "at most so many are known at a time, further ones are refused; the model has no such limit";
constexpr std::string_view protocols = "SIMPLE|NONE|CLIENT|SUPER_CLIENT|SERVER|BACKUP";
constexpr std::array participant_items{
    SchemaItem{"domainId", uint32, "", Effect::none, "all participants of a scenario share it"},
    SchemaItem{"rtps", group, "", Effect::none, ""},
    SchemaItem{"rtps/name", text, "", Effect::none, "ROS 2 puts its own name in its place"},
    SchemaItem{"rtps/userData", opaque, "", Effect::unmodelled,
               "makes every announcement longer; those of the model have the size of ROS 2's"},
    SchemaItem{"rtps/defaultUnicastLocatorList", locators, "", Effect::unmodelled,
               "endpoints announce these addresses, 28 bytes each, and not that of every "
               "interface; descriptors of the model have the size of a host with one"},
    SchemaItem{"rtps/defaultMulticastLocatorList", locators, "", Effect::unmodelled,
               "endpoints announce these addresses, too, 28 bytes each; descriptors of the model "
               "have no multicast address"},
    SchemaItem{"rtps/default_external_unicast_locators", opaque, "", Effect::unmodelled,
               "endpoints announce external addresses, too; descriptors of the model have none", "",
               210},
    SchemaItem{"rtps/ignore_non_matching_locators", flag, "false", Effect::unmodelled,
               "addresses that match no interface are not used; the model has one interface", "",
               210},
    SchemaItem{"rtps/sendSocketBufferSize", uint32, "0", Effect::knob, ""},
    SchemaItem{"rtps/listenSocketBufferSize", uint32, "0", Effect::unmodelled,
               "size of the sockets' receive buffers; a receiver of the model never drops what "
               "arrives"},
    SchemaItem{"rtps/builtin", group, "", Effect::none, ""},
    SchemaItem{"rtps/builtin/discovery_config", group, "", Effect::none, ""},
    SchemaItem{"rtps/builtin/discovery_config/discoveryProtocol", choice, "SIMPLE", Effect::outside,
               "discovery is not the simple one that the model describes", protocols},
    SchemaItem{"rtps/builtin/discovery_config/ignoreParticipantFlags", choices, "NO_FILTER",
               Effect::unmodelled,
               "participants on the same host ignore each other; in the model all discover all",
               "NO_FILTER|FILTER_DIFFERENT_HOST|FILTER_DIFFERENT_PROCESS|FILTER_SAME_PROCESS"},
    SchemaItem{"rtps/builtin/discovery_config/EDP", choice, "SIMPLE", Effect::outside,
               "endpoints come from a file, so no SEDP takes place", "SIMPLE|STATIC"},
    SchemaItem{"rtps/builtin/discovery_config/leaseDuration", duration, "20s", Effect::knob,
               "how long the others remember a participant of which they hear nothing"},
    SchemaItem{"rtps/builtin/discovery_config/leaseAnnouncement", duration, "3s", Effect::knob,
               "period of the announcements after startup"},
    SchemaItem{"rtps/builtin/discovery_config/initialAnnouncements", group, "", Effect::none, ""},
    SchemaItem{"rtps/builtin/discovery_config/initialAnnouncements/count", uint32, "5",
               Effect::knob, "announcements at the startup period, after the immediate one"},
    SchemaItem{"rtps/builtin/discovery_config/initialAnnouncements/period", duration, "100ms",
               Effect::knob, "period of the announcements during startup"},
    SchemaItem{"rtps/builtin/discovery_config/simpleEDP", group, "", Effect::none, ""},
    SchemaItem{"rtps/builtin/discovery_config/simpleEDP/PUBWRITER_SUBREADER", flag, "true",
               Effect::outside, "without it, publications are not announced by SEDP"},
    SchemaItem{"rtps/builtin/discovery_config/simpleEDP/PUBREADER_SUBWRITER", flag, "true",
               Effect::outside, "without it, subscriptions are not announced by SEDP"},
    SchemaItem{"rtps/builtin/discovery_config/clientAnnouncementPeriod", duration, "450ms",
               Effect::none, "acts on clients of a discovery server only"},
    SchemaItem{"rtps/builtin/discovery_config/discoveryServersList", opaque, "", Effect::none,
               "acts on clients of a discovery server only"},
    SchemaItem{"rtps/builtin/discovery_config/staticEndpointXMLFilename", text, "", Effect::none,
               "acts with <EDP>STATIC</EDP> only"},
    SchemaItem{"rtps/builtin/discovery_config/static_edp_xml_config", text, "", Effect::none,
               "acts with <EDP>STATIC</EDP> only"},
    SchemaItem{"rtps/builtin/avoid_builtin_multicast", flag, "true", Effect::unmodelled,
               "HEARTBEATs and DATA of SEDP may go to the multicast group once instead of to each "
               "participant; the model sends them to each"},
    SchemaItem{"rtps/builtin/use_WriterLivelinessProtocol", flag, "true", Effect::unmodelled,
               "there is no liveliness relation; the model has it in its control traffic"},
    SchemaItem{"rtps/builtin/initialPeersList", locators, "", Effect::unmodelled,
               "announcements go to these addresses instead of to the multicast group; the model "
               "announces by multicast"},
    SchemaItem{"rtps/builtin/metatrafficUnicastLocatorList", locators, "", Effect::unmodelled,
               "discovery is received at these addresses, and what goes to a participant goes to "
               "each of them; the model has one address a participant"},
    SchemaItem{"rtps/builtin/metatrafficMulticastLocatorList", locators, "", Effect::unmodelled,
               "announcements go to these groups; the model has the one group that all "
               "participants are in"},
    SchemaItem{"rtps/builtin/metatraffic_external_unicast_locators", opaque, "", Effect::unmodelled,
               "participants announce external addresses, too; those of the model have none", "",
               210},
    SchemaItem{"rtps/builtin/readerHistoryMemoryPolicy", choice, "PREALLOCATED_WITH_REALLOC",
               Effect::none, memory_note, history_policies},
    SchemaItem{"rtps/builtin/writerHistoryMemoryPolicy", choice, "PREALLOCATED_WITH_REALLOC",
               Effect::none, memory_note, history_policies},
    SchemaItem{"rtps/builtin/readerPayloadSize", uint32, "512", Effect::none, memory_note},
    SchemaItem{"rtps/builtin/writerPayloadSize", uint32, "512", Effect::none, memory_note},
    SchemaItem{"rtps/builtin/flow_controller_name", text, "", Effect::unmodelled,
               "paces DATA of SEDP and of what looks up types; in the model they leave at once", "",
               302},
    SchemaItem{"rtps/builtin/mutation_tries", uint32, "100", Effect::knob,
               "ports that are tried after the first: one participant of a host more than that "
               "finds one"},
    SchemaItem{"rtps/port", group, "", Effect::none, ""},
    SchemaItem{"rtps/port/portBase", uint16, "7400", Effect::none, port_note},
    SchemaItem{"rtps/port/domainIDGain", uint16, "250", Effect::none, port_note},
    SchemaItem{"rtps/port/participantIDGain", uint16, "2", Effect::none, port_note},
    SchemaItem{"rtps/port/offsetd0", uint16, "0", Effect::none, port_note},
    SchemaItem{"rtps/port/offsetd1", uint16, "10", Effect::none, port_note},
    SchemaItem{"rtps/port/offsetd2", uint16, "1", Effect::none, port_note},
    SchemaItem{"rtps/port/offsetd3", uint16, "11", Effect::none, port_note},
    SchemaItem{"rtps/participantID", int32, "-1", Effect::none, port_note},
    SchemaItem{"rtps/prefix", text, "", Effect::none, "which GUID; no packet more or less"},
    SchemaItem{"rtps/throughputController", group, "", Effect::none, ""},
    SchemaItem{"rtps/throughputController/bytesPerPeriod", uint32, "4294967295", Effect::unmodelled,
               "announcements wait for their turn in a paced queue; the model sends them at once"},
    SchemaItem{"rtps/throughputController/periodMillisecs", uint32, "0", Effect::unmodelled,
               "announcements wait for their turn in a paced queue; the model sends them at once"},
    SchemaItem{"rtps/userTransports", transports, "", Effect::none, "which transports are used"},
    SchemaItem{"rtps/useBuiltinTransports", flag, "true", Effect::none,
               "only the user transports are used"},
    SchemaItem{"rtps/builtinTransports", choice, "DEFAULT", Effect::none,
               "which transports are used",
               "DEFAULT|NONE|DEFAULTv6|SHM|UDPv4|UDPv6|LARGE_DATA|LARGE_DATAv6"},
    SchemaItem{"rtps/propertiesPolicy", properties, "", Effect::none, ""},
    SchemaItem{"rtps/allocation", group, "", Effect::none, ""},
    SchemaItem{"rtps/allocation/remote_locators", group, "", Effect::none, ""},
    SchemaItem{"rtps/allocation/remote_locators/max_unicast_locators", uint32, "4", Effect::none,
               allocation_note},
    SchemaItem{"rtps/allocation/remote_locators/max_multicast_locators", uint32, "1", Effect::none,
               allocation_note},
    SchemaItem{"rtps/allocation/total_participants", group, "", Effect::none, ""},
    SchemaItem{"rtps/allocation/total_participants/initial", uint32, "0", Effect::none,
               allocation_note},
    SchemaItem{"rtps/allocation/total_participants/maximum", uint32, "0", Effect::unmodelled,
               limit_note},
    SchemaItem{"rtps/allocation/total_participants/increment", uint32, "1", Effect::none,
               allocation_note},
    SchemaItem{"rtps/allocation/total_readers", group, "", Effect::none, ""},
    SchemaItem{"rtps/allocation/total_readers/initial", uint32, "0", Effect::none, allocation_note},
    SchemaItem{"rtps/allocation/total_readers/maximum", uint32, "0", Effect::unmodelled,
               limit_note},
    SchemaItem{"rtps/allocation/total_readers/increment", uint32, "1", Effect::none,
               allocation_note},
    SchemaItem{"rtps/allocation/total_writers", group, "", Effect::none, ""},
    SchemaItem{"rtps/allocation/total_writers/initial", uint32, "0", Effect::none, allocation_note},
    SchemaItem{"rtps/allocation/total_writers/maximum", uint32, "0", Effect::unmodelled,
               limit_note},
    SchemaItem{"rtps/allocation/total_writers/increment", uint32, "1", Effect::none,
               allocation_note},
    SchemaItem{"rtps/allocation/send_buffers", group, "", Effect::none, ""},
    SchemaItem{"rtps/allocation/send_buffers/preallocated_number", uint32, "0", Effect::none,
               allocation_note},
    SchemaItem{"rtps/allocation/send_buffers/dynamic", flag, "false", Effect::none,
               allocation_note},
    SchemaItem{"rtps/allocation/max_properties", uint32, "0", Effect::none, allocation_note},
    SchemaItem{"rtps/allocation/max_user_data", uint32, "0", Effect::none, allocation_note},
    SchemaItem{"rtps/allocation/max_partitions", uint32, "0", Effect::none, allocation_note},
    SchemaItem{"rtps/builtin_controllers_sender_thread", opaque, "", Effect::none, thread_note, "",
               213},
    SchemaItem{"rtps/timed_events_thread", opaque, "", Effect::none, thread_note, "", 213},
    SchemaItem{"rtps/discovery_server_thread", opaque, "", Effect::none, thread_note, "", 213},
    SchemaItem{"rtps/typelookup_service_thread", opaque, "", Effect::none, thread_note, "", 213},
    SchemaItem{"rtps/builtin_transports_reception_threads", opaque, "", Effect::none, thread_note,
               "", 213},
    SchemaItem{"rtps/security_log_thread", opaque, "", Effect::none, thread_note, "", 213},
    SchemaItem{"rtps/easy_mode_ip", text, "", Effect::outside,
               "discovery goes through servers on every host", "", 302}};

}  // namespace

std::string print_version(Version version) {
  return fmt::format("{}.{}", version / 100, version % 100);
}

Version version_of(std::string_view base) {
  constexpr std::string_view prefix = "fastdds-";
  int major = 0;
  int minor = 0;
  if (!base.starts_with(prefix)) return oldest_version;
  base.remove_prefix(prefix.size());
  for (const std::string_view way : {"server-", "static-"}) {
    if (base.starts_with(way)) base.remove_prefix(way.size());
  }
  const char* end = base.data() + base.size();
  const auto [dot, failed] = std::from_chars(base.data(), end, major);
  if (failed != std::errc{} || dot == end || *dot != '.' || major > 99) return oldest_version;
  if (std::from_chars(dot + 1, end, minor).ec != std::errc{} || minor > 99) return oldest_version;
  return major * 100 + minor;
}

std::span<const SchemaItem> participant_schema() { return participant_items; }

const SchemaItem* find_item(std::span<const SchemaItem> schema, std::string_view path) {
  const auto found = std::ranges::find(schema, path, &SchemaItem::path);
  return found == schema.end() ? nullptr : &*found;
}

std::optional<std::string> home_of(std::string_view name) {
  using SchemaSection = std::pair<std::string_view, std::span<const SchemaItem>>;
  const std::array<SchemaSection, 4> sections{SchemaSection{"participant", participant_items},
                                              {"transport_descriptor", transport_schema()},
                                              {"data_writer", writer_schema()},
                                              {"data_reader", reader_schema()}};
  for (const auto& [section, schema] : sections) {
    for (const SchemaItem& item : schema) {
      if (is_same_word(item.name(), name)) return fmt::format("{}/{}", section, item.path);
    }
  }
  return std::nullopt;
}

}  // namespace stormproof::model::config::vendor::fastdds
