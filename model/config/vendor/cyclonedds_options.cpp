// From the configuration tables of Cyclone DDS 0.10.5 and 11.0.1 (src/core/ddsi, ddsi_cfgelems.h
// and the parser functions of ddsi_config.c) and their manual (docs/manual/options.md). Ranges are
// those that the parser enforces.
#include <vector>

#include "model/config/vendor/cyclonedds_option_words.hpp"

namespace stormproof::model::config::vendor {
namespace {

using namespace cyclone;

constexpr std::string_view indices =
    "with automatic indices, how many participants a host can have; peers without a port get an "
    "announcement for each";

constexpr CycloneOption options[] = {
    {"General/AllowMulticast", choices("default,false,spdp,asm,ssm,true"), "default", knob,
     "decides whether SPDP and SEDP go by multicast", "allow_multicast"},
    {"General/DontRoute", boolean, "false", none, "routing of packets"},
    {"General/EnableMulticastLoopback", boolean, "true", none,
     "acts between processes on one host; this model looks at discovery across hosts"},
    {"General/EntityAutoNaming", choice("empty,fancy"), "empty", assumed,
     "entity names make announcements and descriptors larger"},
    {"General/EntityAutoNaming[@seed]", text_type, "", none, "names of entities"},
    {"General/ExternalNetworkAddress", text_type, "auto", none, "the address that is announced"},
    {"General/ExternalNetworkMask", text_type, "0.0.0.0", none, "the address that is announced"},
    {"General/FragmentSize",
     {CycloneKind::size, 0, 65'535},
     "1344 B",
     none,
     "fragments larger samples; descriptors of usual length are smaller"},
    {"General/Interfaces/NetworkInterface[@address]", text_type, "", none, names},
    {"General/Interfaces/NetworkInterface[@autodetermine]", boolean, "false", none, names},
    {"General/Interfaces/NetworkInterface[@multicast]", boolean_or_default, "default", assumed,
     "whether announcements and SEDP may use multicast on this interface"},
    {"General/Interfaces/NetworkInterface[@name]", text_type, "", none, names},
    {"General/Interfaces/NetworkInterface[@prefer_multicast]", boolean, "false", assumed,
     "multicast even for a single reader; the model sends to that by unicast"},
    {"General/Interfaces/NetworkInterface[@presence_required]", boolean, "true", none, names},
    {"General/Interfaces/NetworkInterface[@priority]", integer_or_default, "default", none, names},
    {"General/Interfaces/NetworkInterface[@allow_multicast]",
     choices("default,false,spdp,asm,ssm,true"), "default", assumed,
     "whether announcements and SEDP may use multicast on this interface", "", false, false,
     from_11},
    {"General/MaxMessageSize", size, "14720 B", knob, "largest packet without repairs",
     "sedp.max_message_size"},
    {"General/MaxRexmitMessageSize", size, "1456 B", knob, "largest packet with repairs",
     "sedp.max_rexmit_message_size"},
    {"General/MulticastRecvNetworkInterfaceAddresses", text_type, "preferred", assumed,
     "on which interfaces announcements are heard; the model hears all"},
    {"General/MulticastTimeToLive", between(0, 255), "32", none,
     "how many routers multicast may pass"},
    {"General/NetworkInterfaceAddress", text_type, "auto", none, names, {}, false, true},
    {"General/PreferMulticast",
     boolean,
     "false",
     assumed,
     "multicast even for a single reader; the model sends to that by unicast",
     {},
     false,
     true},
    {"General/RedundantNetworking", boolean, "false", assumed,
     "every packet goes out on every interface; the model has one"},
    {"General/Transport", choice("default,udp,udp6,tcp,tcp6,raweth,none"), "default", assumed,
     "IPv6 headers are 20 B longer than those of this model"},
    {"General/UseIPv6",
     boolean_or_default,
     "default",
     assumed,
     "IPv6 headers are 20 B longer than those of this model",
     {},
     false,
     true},

    {"Compatibility/AssumeRtiHasPmdEndpoints", boolean, "false", none,
     "acts with another vendor's participants only"},
    {"Compatibility/ExplicitlyPublishQosSetToDefault", boolean, "false", assumed,
     "makes descriptors larger than those of this model"},
    {"Compatibility/AllowInvalidTryConstruct", boolean, "false", none, user, "", false, false,
     from_11},
    {"Compatibility/IgnoreTypeInformation", text_type, "", none, user, "", false, false, from_11},
    {"Compatibility/ProtocolVersion", text_type, "2.5", none, "what the RTPS header says", "",
     false, false, from_11},
    {"Compatibility/ManySocketsMode", choice("false,true,single,none,many"), "single", assumed,
     "sockets of processes with several participants; the model has one for each participant"},
    {"Compatibility/StandardsConformance", choice("lax,strict,pedantic"), "lax", none,
     "how strictly packets are judged"},

    {"Discovery/DSGracePeriod", or_inf, "30 s", none, "acts with a discovery service in the cloud"},
    {"Discovery/DefaultMulticastAddress", text_type, "auto", none, user},
    {"Discovery/EnableTopicDiscoveryEndpoints", boolean, "false", assumed,
     "one more builtin relation per pair, for topics; the model has two"},
    {"Discovery/ExternalDomainId", integer_or_default, "default", none, "the domain's number"},
    {"Discovery/LeaseDuration", upto_hour, "10 s", knob,
     "bounds the announcement period: 2 s less, or 80 % of it below 10 s; a participant silent for "
     "so long is dropped, which the model has not",
     "spdp.period"},
    {"Discovery/DiscoveredLocatorPruneDelay", or_inf, "60 s", knob,
     "how long addresses of participants that fell silent are announced to",
     "spdp.discovered_prune_delay", false, false, from_11},
    {"Discovery/InitialLocatorPruneDelay", or_inf, "30 s", knob,
     "how long peers that do not answer are announced to", "spdp.initial_prune_delay", false, false,
     from_11},
    {"Discovery/MaxAutoParticipantIndex", between(0, 2'147'483'647), "9", none, indices, "", false,
     false, only_0_10},
    {"Discovery/MaxAutoParticipantIndex", between(0, 2'147'483'647), "99", none, indices, "", false,
     false, from_11},
    {"Discovery/ParticipantIndex", between(0, 120, "auto,none"), "none", none, port, "", false,
     false, only_0_10},
    {"Discovery/ParticipantIndex", between(0, 120, "auto,default,none"), "default", none, port, "",
     false, false, from_11},
    {"Discovery/Peers/Peer[@Address]", text_type, "", assumed,
     "announcements go there by unicast, too"},
    {"Discovery/Peers/Peer[@PruneDelay]", inf_or_default, "default", assumed,
     "how long this peer is announced to without an answer", "", false, false, from_11},
    {"Discovery/Peers[@AddLocalhost]", boolean_or_default, "default", none,
     "acts between processes on one host; this model looks at discovery across hosts", "", false,
     false, from_11},
    {"Discovery/Ports/Base", natural, "7400", none, port},
    {"Discovery/Ports/DomainGain", natural, "250", none, port},
    {"Discovery/Ports/MulticastDataOffset", natural, "1", none, port},
    {"Discovery/Ports/MulticastMetaOffset", natural, "0", none, port},
    {"Discovery/Ports/ParticipantGain", natural, "2", none, port},
    {"Discovery/Ports/UnicastDataOffset", natural, "11", none, port},
    {"Discovery/Ports/UnicastMetaOffset", natural, "10", none, port},
    {"Discovery/SPDPInterval", upto_hour, "30 s", knob,
     "announcement period, if LeaseDuration does not ask for a shorter one", "spdp.period", false,
     false, only_0_10},
    {"Discovery/SPDPInterval", upto_hour_or_default, "default", knob, "announcement period",
     "spdp.period", false, false, from_11},
    {"Discovery/SPDPMulticastAddress", text_type, "239.255.0.1", none,
     "address of the announcements"},
    {"Discovery/Tag", text_type, "", none, "participants with another tag ignore each other"},

    {"SharedMemory/Enable", boolean, "false", none, user},
    {"SharedMemory/Locator", text_type, "", none, user},
    {"SharedMemory/LogLevel", choice("off,fatal,error,warn,info,debug,verbose"), "info", none, log},
    {"SharedMemory/Prefix", text_type, "DDS_CYCLONE", none, user},
    {"Sizing/ReceiveBufferChunkSize", size, "128 KiB", none, receive_buffer},
    {"Sizing/ReceiveBufferSize", size, "1 MiB", none, receive_buffer},
    {"TCP/AlwaysUsePeeraddrForUnicast", boolean, "false", none, tcp},
    {"TCP/Enable",
     boolean_or_default,
     "default",
     Effect::outside,
     "DDSI over TCP repeats and orders packets itself, which this model has not",
     {},
     false,
     true},
    {"TCP/NoDelay", boolean, "true", none, tcp},
    {"TCP/Port", between(-1, 65'535), "-1", none, tcp},
    {"TCP/ReadTimeout", upto_hour, "2 s", none, tcp},
    {"TCP/WriteTimeout", upto_hour, "2 s", none, tcp},
    {"Tracing/AppendToFile", boolean, "false", none, log},
    {"Tracing/Category",
     choices("fatal,error,warning,info,config,discovery,data,radmin,timing,traffic,topic,tcp,plist,"
             "whc,throttle,rhc,content,shm,trace"),
     "", none, log},
    {"Tracing/OutputFile", text_type, "cyclonedds.log", none, log},
    {"Tracing/PacketCaptureFile", text_type, "", none, log},
    {"Tracing/Verbosity", choice("finest,finer,fine,config,info,warning,severe,none"), "none", none,
     log},
};

constexpr CycloneGroup opaque_groups[] = {
    {"General/AddrsetCosts", assumed, "by which costs a writer chooses between addresses", from_11},
    {"General/Interfaces/NetworkInterface/AddrsetCosts", assumed,
     "by which costs a writer chooses between addresses", from_11},
    {"General/Interfaces/PubSubMessageExchange", Effect::none,
     "user data between processes of one host", from_11},
    {"Partitioning", Effect::none, "maps user topics to network partitions"},
    {"SSL", Effect::none, "acts with the TCP transport only"},
    {"Security", Effect::outside,
     "DDS Security authenticates participants before SEDP, which this model has not"},
    {"Threads", Effect::none, "threads; processing takes no time in this model"},
};

constexpr CycloneAlias aliases[] = {
    {"Unsupported", "Internal"},
    {"DDSSecurity", "Security"},
    {"Internal/FragmentSize", "General/FragmentSize"},
    {"Internal/LeaseDuration", "Discovery/LeaseDuration"},
    {"Internal/MaxMessageSize", "General/MaxMessageSize"},
    {"Internal/MinimumSocketReceiveBufferSize", "Internal/SocketReceiveBufferSize[@min]"},
    {"Internal/MinimumSocketSendBufferSize", "Internal/SocketSendBufferSize[@min]"},
    {"Internal/Watermarks/WhcAdaptative", "Internal/Watermarks/WhcAdaptive"},
    {"Tracing/EnableCategory", "Tracing/Category"},
};

constexpr std::string_view newer = "11.0 and later";
constexpr std::string_view older = "versions before 0.10";
constexpr std::string_view before_11 = "versions before 11.0";
constexpr CycloneForeign foreign[] = {
    {"Channels", older},
    {"Compatibility/ProtocolVersion", newer},
    {"Discovery/AdvertiseBuiltinTopicWriters", older},
    {"Discovery/DiscoveredLocatorPruneDelay", newer},
    {"Discovery/InitialLocatorPruneDelay", newer},
    {"Discovery/Peers/Peer[@PruneDelay]", newer},
    {"Discovery/Peers[@AddLocalhost]", newer},
    {"General/AddrsetCosts", newer},
    {"General/CoexistWithNativeNetworking", older},
    {"General/Interfaces/NetworkInterface/AddrsetCosts", newer},
    {"General/Interfaces/NetworkInterface[@allow_multicast]", newer},
    {"General/Interfaces/PubSubMessageExchange", newer},
    {"Internal/AggressiveKeepLastWhc", older},
    {"Internal/AuxiliaryBandwidthLimit", older},
    {"Internal/BurstSize/MaxFragsRexmitSample", newer},
    {"Internal/ConservativeBuiltinReaderStartup", older},
    {"Internal/DDSI2DirectMaxThreads", before_11},
    {"Internal/ExtendedPacketInfo", newer},
    {"Internal/SuppressSPDPMulticast", older},
    {"Internal/UnicastResponseToSPDPMessages", before_11},
};

bool has(CycloneHas versions, CycloneVersion version) {
  if (versions == CycloneHas::both) return true;
  return (versions == CycloneHas::from_11) == (version == CycloneVersion::of_11);
}

std::vector<CycloneOption> options_of(CycloneVersion version) {
  std::vector<CycloneOption> all{std::begin(options), std::end(options)};
  const auto internal = internal_options();
  all.insert(all.end(), internal.begin(), internal.end());
  std::erase_if(all, [version](const CycloneOption& one) { return !has(one.versions, version); });
  return all;
}

std::vector<CycloneGroup> groups_of(CycloneVersion version) {
  std::vector<CycloneGroup> all{std::begin(opaque_groups), std::end(opaque_groups)};
  std::erase_if(all, [version](const CycloneGroup& one) { return !has(one.versions, version); });
  return all;
}

}  // namespace

CycloneVersion cyclone_version_of(std::string_view base) {
  return base.starts_with("cyclonedds-11") ? CycloneVersion::of_11 : CycloneVersion::of_0_10;
}

std::string_view print_version(CycloneVersion version) {
  return version == CycloneVersion::of_11 ? "11" : "0.10";
}

std::span<const CycloneOption> cyclone_options(CycloneVersion version) {
  static const std::vector<CycloneOption> of_0_10 = options_of(CycloneVersion::of_0_10);
  static const std::vector<CycloneOption> of_11 = options_of(CycloneVersion::of_11);
  return version == CycloneVersion::of_11 ? of_11 : of_0_10;
}
std::span<const CycloneGroup> cyclone_opaque_groups(CycloneVersion version) {
  static const std::vector<CycloneGroup> of_0_10 = groups_of(CycloneVersion::of_0_10);
  static const std::vector<CycloneGroup> of_11 = groups_of(CycloneVersion::of_11);
  return version == CycloneVersion::of_11 ? of_11 : of_0_10;
}
std::span<const CycloneAlias> cyclone_aliases() { return aliases; }
std::span<const CycloneForeign> cyclone_foreign() { return foreign; }

}  // namespace stormproof::model::config::vendor
