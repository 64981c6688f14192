// The participant's own settings of discovery. Rules of the library (v2.6.11): PDP.cpp:1341-1350
// makes a startup period that is not positive one of 1 ms; RTPSDomain refuses a participant whose
// lease is not longer than its announcement period; only <EDP>STATIC</EDP> reads static files.
#include "model/config/vendor/fastdds_discovery.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/core.h>

#include "model/config/knobs/value_types.hpp"
#include "model/config/tree/quantities.hpp"
#include "model/config/tree/suggestion.hpp"

namespace stormproof::model::config::vendor::fastdds {
namespace {

constexpr std::string_view discovery = "rtps/builtin/discovery_config/";
/// Every client is told everything (Fast DDS #6272).
constexpr Version all_are_super_clients = 305;
constexpr std::int64_t max_announcements = 1'000'000;  ///< of spdp.startup_announcements

const Found* find_discovery(const Reading& reading, std::string_view name) {
  return reading.section.find(std::string{discovery} + std::string{name});
}

/// A period as a profile has it; what is longer than the longest one outlasts every run as well.
std::string period_of(const Value& value) {
  return print_duration(Nanoseconds{std::min(value.number, max_duration_ns)});
}

void interpret_startup(Reading& reading) {
  const Found* count = find_discovery(reading, "initialAnnouncements/count");
  const Found* period = find_discovery(reading, "initialAnnouncements/period");
  if (count != nullptr) {
    if (count->value.number > max_announcements) {
      refuse(count->value.place, fmt::format("{} in <count>; expected {} announcements at most",
                                             count->value.number, max_announcements));
    }
    set_knob(reading, *count, "spdp", "startup_announcements", count->value.shown);
  }
  if (period == nullptr) return;
  if (count != nullptr && count->value.number == 0) {
    set_inert(reading, *period, "no announcements at the startup period");
    return add_remark(reading.profile, Severity::note, "fastdds.unused-startup-period",
                      period->value.place, "<period> does nothing, because <count> is 0");
  }
  if (period->value.number > 0) {
    return set_knob(reading, *period, "spdp", "startup_period", period_of(period->value));
  }
  set_knob(reading, *period, "spdp", "startup_period", "1ms");
  reading.setting_of(*period).note = "not positive, so the library uses 1 ms";
  add_remark(reading.profile, Severity::warning, "fastdds.startup-period", period->value.place,
             fmt::format("a startup period of {} becomes 1 ms", period->value.shown),
             "to switch startup announcements off, set <count> to 0");
}

void interpret_lease(Reading& reading) {
  constexpr std::int64_t default_lease = 20'000'000'000;
  constexpr std::int64_t default_period = 3'000'000'000;
  const Found* lease = find_discovery(reading, "leaseDuration");
  const Found* period = find_discovery(reading, "leaseAnnouncement");
  if (period != nullptr) {
    if (period->value.number <= 0) {
      refuse(period->value.place,
             fmt::format("{} in <leaseAnnouncement>; expected more than 0", period->value.shown));
    }
    set_knob(reading, *period, "spdp", "period", period_of(period->value));
  }
  if (lease != nullptr && lease->value.number > 0 && lease->value.number != default_lease) {
    set_knob(reading, *lease, "spdp", "lease", period_of(lease->value));
  }
  const std::int64_t lasts = lease == nullptr ? default_lease : lease->value.number;
  const bool is_infinite = lease != nullptr && lease->value.infinite;
  const std::int64_t renewed = period == nullptr ? default_period : period->value.number;
  if (is_infinite || lasts > renewed || (lease == nullptr && period == nullptr)) return;
  const Found& cause = period != nullptr ? *period : *lease;
  add_remark(reading.profile, Severity::error, "fastdds.lease-announcement", cause.value.place,
             fmt::format("leaseAnnouncement is {}, leaseDuration {}{}; the library creates no "
                         "participant unless the lease is longer",
                         period == nullptr ? "3s" : period->value.shown,
                         lease == nullptr ? "20s" : lease->value.shown,
                         lease == nullptr || period == nullptr ? " (the default of one)" : ""),
             "announce several times within a lease");
}

void remark_super_client(Reading& reading, const Found& protocol) {
  const std::string* is_default = reading.participant->attribute("is_default_profile");
  if (protocol.value.shown != "SUPER_CLIENT" || is_default == nullptr || *is_default != "true") {
    return;
  }
  add_remark(reading.profile, Severity::warning, "fastdds.super-client", protocol.value.place,
             "as the default profile it makes every participant a super client, which is told of "
             "every endpoint of the system",
             "CLIENT for nodes; SUPER_CLIENT for tools that list the system");
}

/// The period of a server whose profile stands in the same file: its routine has it.
void interpret_server_beside(Reading& reading) {
  const XmlElement* period = nullptr;
  for (const XmlElement* one : participants_of(*reading.root)) {
    const XmlElement* config = one;
    for (const char* name : {"rtps", "builtin", "discovery_config"}) {
      if (config != nullptr) config = config->find(name);
    }
    const XmlElement* protocol = config == nullptr ? nullptr : config->find("discoveryProtocol");
    if (protocol == nullptr || protocol->text != "SERVER") continue;
    if (period == nullptr) period = config->find("clientAnnouncementPeriod");
  }
  if (period == nullptr) return;
  const SchemaItem* item =
      find_item(participant_schema(), "rtps/builtin/discovery_config/clientAnnouncementPeriod");
  const Value value = read_value(*period, *item, reading.profile);
  if (value.number <= 0) return;
  reading.profile.settings.push_back(
      {"rtps/builtin/discovery_config/clientAnnouncementPeriod of the server", value.shown,
       value.place, Effect::knob, "server_routine_period",
       "until the server looks again who has acknowledged what"});
  (void)set_path(reading.profile.changes, "server_routine_period",
                 Node::scalar(value.place, period_of(value)));
}

/// The addresses of servers in a list of either syntax; a server without one is none.
std::vector<std::string> servers_in(const XmlElement& list, Reading& reading) {
  std::vector<std::string> servers;
  const auto take = [&](const XmlElement& locator) {
    if (locator.name != "locator") return;
    std::string server = read_locator(locator, reading.profile);
    const std::size_t blank = server.find(' ');
    if (blank + 1 < server.size() && server[blank + 1] != ':') servers.push_back(std::move(server));
  };
  for (const XmlElement& one : list.children) {
    take(one);
    bool has_list = false;
    for (const XmlElement& locators : one.children) {
      if (one.name != "RemoteServer" || !locators.name.ends_with("LocatorList")) continue;
      has_list = true;
      for (const XmlElement& locator : locators.children) take(locator);
    }
    if (one.name != "RemoteServer" || reading.version >= servers_by_address) continue;
    if (has_list && one.attribute("prefix") != nullptr) continue;
    add_remark(reading.profile, Severity::error, "fastdds.remote-server", one.place,
               fmt::format("<RemoteServer> without {}; the library refuses the file",
                           has_list ? "a prefix" : "a <metatrafficUnicastLocatorList>"),
               "both say who the server is, and where");
  }
  return servers;
}

/// A client asks its servers, and nobody else: it needs the address of one, by UDP over IPv4. How
/// many there are the deployment says.
void look_for_servers(Reading& reading, const Found& protocol) {
  const Found* list = find_discovery(reading, "discoveryServersList");
  const auto servers =
      list == nullptr ? std::vector<std::string>{} : servers_in(*list->element, reading);
  if (servers.empty()) {
    return set_outside(reading, protocol,
                       "a client without the address of a server finds nobody: "
                       "<discoveryServersList> has none, and ROS_DISCOVERY_SERVER is read where "
                       "the protocol is SIMPLE only");
  }
  if (servers.size() > 1) {
    reading.setting_of(protocol).note = fmt::format(
        "its {} servers are deployment.servers of the scenario; their addresses do not "
        "matter",
        servers.size());
  }
  for (const auto& [kind, what] : {std::pair{"tcp", "TCP"}, {"udpv6", "IPv6"}}) {
    const auto is_other = [kind = kind](const std::string& one) { return !one.starts_with(kind); };
    if (std::ranges::any_of(servers, is_other)) continue;
    set_outside(reading, *list, fmt::format("the server is reached by {} alone", what));
  }
}

/// A client, or a super client. Returns whether it is.
bool interpret_client(Reading& reading) {
  const Found* protocol = find_discovery(reading, "discoveryProtocol");
  if (protocol == nullptr) return false;
  const std::string& word = protocol->value.shown;
  if (word != "CLIENT" && word != "SUPER_CLIENT") return false;
  const bool is_super = word == "SUPER_CLIENT" || reading.version >= all_are_super_clients;
  set_knob(reading, *protocol, "", "discovery", is_super ? "super_client" : "server");
  reading.setting_of(*protocol).note =
      word == "CLIENT" && is_super
          ? "one Discovery Server on host 0, which since 3.5 tells every client everything; its "
            "address does not matter"
          : "one Discovery Server on host 0; its address does not matter";
  look_for_servers(reading, *protocol);
  const Found* period = find_discovery(reading, "clientAnnouncementPeriod");
  if (period != nullptr && period->value.number > 0) {
    set_knob(reading, *period, "", "client_sync_period", period_of(period->value));
    reading.setting_of(*period).note = "until a client matches its endpoints with the server's";
  }
  interpret_server_beside(reading);
  return true;
}

void interpret_protocol(Reading& reading, bool is_client) {
  for (const std::string_view name : {"discoveryProtocol", "EDP", "simpleEDP/PUBWRITER_SUBREADER",
                                      "simpleEDP/PUBREADER_SUBWRITER"}) {
    const Found* found = find_discovery(reading, name);
    if (found == nullptr || reading.setting_of(*found).effect != Effect::outside) continue;
    if (is_client && name == "discoveryProtocol") continue;  // it has been said why
    set_outside(reading, *found, std::string{found->item->note});
  }
  if (const Found* flags = find_discovery(reading, "ignoreParticipantFlags")) {
    const auto& items = flags->value.items;
    if (std::ranges::find(items, "FILTER_DIFFERENT_HOST") != items.end()) {
      set_outside(reading, *flags, "participants of different hosts ignore each other");
    }
  }
  const Found* protocol = find_discovery(reading, "discoveryProtocol");
  if (protocol != nullptr) remark_super_client(reading, *protocol);
  if (!is_client && (protocol == nullptr || protocol->value.shown == "SIMPLE")) {
    for (const std::string_view name : {"clientAnnouncementPeriod", "discoveryServersList"}) {
      const Found* found = find_discovery(reading, name);
      if (found == nullptr) continue;
      add_remark(
          reading.profile, Severity::warning, "fastdds.discovery-server-setting",
          found->value.place,
          fmt::format("<{}> does nothing with the discovery protocol SIMPLE", found->item->name()),
          "set <discoveryProtocol>CLIENT</discoveryProtocol> to use a discovery server");
    }
  }
  const Found* endpoints = find_discovery(reading, "EDP");
  if (endpoints != nullptr && endpoints->value.shown == "STATIC") return;
  for (const std::string_view name : {"staticEndpointXMLFilename", "static_edp_xml_config"}) {
    const Found* found = find_discovery(reading, name);
    if (found == nullptr) continue;
    add_remark(reading.profile, Severity::warning, "fastdds.static-edp-file", found->value.place,
               fmt::format("<{}> does nothing without <EDP>STATIC</EDP>", found->item->name()));
  }
}

void interpret_throughput(Reading& reading) {
  const Found* bytes = reading.section.find("rtps/throughputController/bytesPerPeriod");
  const Found* period = reading.section.find("rtps/throughputController/periodMillisecs");
  const Found* first = bytes != nullptr ? bytes : period;
  if (first == nullptr) return;
  const bool is_limited = bytes != nullptr && period != nullptr && period->value.number != 0 &&
                          reading.setting_of(*bytes).effect == Effect::unmodelled;
  if (!is_limited) {
    for (const Found* found : {bytes, period}) {
      if (found != nullptr) set_inert(reading, *found, "without the other one there is no limit");
    }
  }
  add_remark(reading.profile, Severity::warning, "fastdds.throughput-controller",
             first->value.place,
             "a throughput controller does not pace SEDP: its writers are synchronous, and the "
             "library ignores the controller for them",
             "it delays announcements and user data only");
}

/// A peer that is no multicast group and has no port.
bool is_bare_host(std::string_view locator) {
  const std::size_t space = locator.find(' ');
  const std::string_view address = locator.substr(space == std::string_view::npos ? 0 : space + 1);
  const bool has_port = address.find(':') != std::string_view::npos && !address.ends_with(":0");
  int first = 0;
  (void)std::from_chars(address.data(), address.data() + address.size(), first);
  return locator.starts_with("udpv4") && !has_port && (first < 224 || first > 239);
}

/// The range of a transport that the participant uses; null if none says one.
const Found* peer_range(const Reading& reading) {
  for (const Transport& transport : reading.transports) {
    const Found* range = transport.section.find("maxInitialPeersRange");
    if (transport.is_used && range != nullptr) return range;
  }
  return nullptr;
}

/// The first port, and each that is tried after it.
void interpret_ports(Reading& reading) {
  const Found* tries = reading.section.find("rtps/builtin/mutation_tries");
  if (tries == nullptr) return;
  constexpr std::int64_t most = 999'999;
  set_knob(reading, *tries, "", "max_participants_per_host",
           fmt::format("{}", std::min(tries->value.number, most) + 1));
}

/// What users of unicast peers run into.
void remark_peers(Reading& reading, const Found& peers) {
  if (std::ranges::none_of(peers.value.items, is_bare_host)) return;
  const Found* range = peer_range(reading);
  add_remark(
      reading.profile, Severity::note, "fastdds.peer-ports", peers.value.place,
      fmt::format("a peer without a port is asked at the ports of its first {} participants; "
                  "later ones on that host are not found from here",
                  range == nullptr ? "4" : range->value.shown),
      "maxInitialPeersRange of the transport raises it");
}

/// Hosts without ports are static peers; with a group or a port among them, announcements go where
/// the model has none.
void interpret_peers(Reading& reading, bool is_client) {
  const Found* peers = reading.section.find("rtps/builtin/initialPeersList");
  if (peers == nullptr) return;
  remark_peers(reading, *peers);
  if (is_client) return set_inert(reading, *peers, "clients announce themselves to their server");
  const Found* range = peer_range(reading);
  if (!peers->value.items.empty() && std::ranges::all_of(peers->value.items, is_bare_host)) {
    set_knob(reading, *peers, "", "discovery", "static");
    reading.setting_of(*peers).note =
        "announcements go to ports of every host of the deployment; the addresses do not matter";
    if (range == nullptr) return;
    set_knob(reading, *range, "", "peer_ports", range->value.shown);
    reading.setting_of(*range).note = "ports of each host that announcements go to";
    return;
  }
  if (range == nullptr || range->value.shown == "4") return;
  Setting& setting = reading.setting_of(*range);
  setting.effect = Effect::unmodelled;
  setting.note =
      "an announcement goes to so many ports of each initial peer that has none; the "
      "model announces by multicast";
}

/// Which types participants tell each other, and with that whether they look them up.
void interpret_type_propagation(Reading& reading) {
  const Found* propagation = reading.section.find("fastdds.type_propagation");
  if (propagation == nullptr || propagation->item->since > reading.version) return;
  const std::string& value = propagation->value.shown;
  const bool on = value == "enabled" || value == "minimal_bandwidth";
  if (!on && value != "disabled" && value != "registration_only") {
    refuse(propagation->value.place,
           fmt::format("{} as fastdds.type_propagation; expected disabled, enabled, "
                       "minimal_bandwidth or registration_only",
                       quote(value)));
  }
  set_knob(reading, *propagation, "", "type_lookup", on ? "true" : "false");
}

void interpret_properties(Reading& reading) {
  std::vector<std::string> known;
  for (const SchemaItem& item : property_schema()) known.emplace_back(item.path);
  const std::string security = "dds.sec.";
  std::size_t hints_left = 1000;  // a hint compares with every name there is
  for (const Found& found : reading.section.found) {
    if (found.element->name != "property") continue;
    const std::string& name = found.element->find("name")->text;
    Setting& setting = reading.setting_of(found);
    if (name.starts_with(security)) {
      setting.effect = Effect::unmodelled;
      setting.note =
          "participants authenticate each other before SEDP, which is encrypted; the "
          "model has no handshake";
    } else if (found.item->since > reading.version) {
      set_inert(reading, found, "not read by this version of the library");
      add_remark(
          reading.profile, Severity::warning, "fastdds.later-property", found.element->place,
          fmt::format("property {} is not read by Fast DDS {}; it is there since {}", quote(name),
                      print_version(reading.version), print_version(found.item->since)),
          "choose the version of the library that reads the file: FILE@PRESET");
    } else if (found.item->path.empty() && hints_left > 0) {
      --hints_left;
      const std::string suggested = suggestion(name, known);
      if (suggested.empty()) continue;
      add_remark(
          reading.profile, Severity::warning, "fastdds.unknown-property", found.element->place,
          fmt::format("property {} is none that Fast DDS reads", quote(name)), suggested.substr(2));
    }
  }
  if (const Found* push = reading.section.find("fastdds.push_mode")) {
    add_remark(reading.profile, Severity::warning, "fastdds.push-mode", push->value.place,
               "fastdds.push_mode does nothing in a participant's profile, and never acts on SEDP",
               "it belongs into the profile of a writer");
  }
  interpret_type_propagation(reading);
  if (const Found* metatraffic = reading.section.find("fastdds.shm.enforce_metatraffic")) {
    const std::string& value = metatraffic->value.shown;
    if (value != "none" && value != "unicast" && value != "all") {
      refuse(metatraffic->value.place,
             fmt::format("{} as fastdds.shm.enforce_metatraffic; expected none, unicast or all",
                         quote(value)));
    }
  }
}

}  // namespace

void set_knob(Reading& reading, const Found& found, std::string_view section, std::string_view key,
              std::string value) {
  Setting& setting = reading.setting_of(found);
  setting.effect = Effect::knob;
  setting.knob = join_path(section, key);
  if (setting.note == "the library's default") setting.note = found.item->note;
  // The path has no empty part and only maps on its way, so this cannot fail.
  (void)set_path(reading.profile.changes, setting.knob,
                 Node::scalar(found.value.place, std::move(value)));
}

void set_inert(Reading& reading, const Found& found, std::string note) {
  Setting& setting = reading.setting_of(found);
  setting.effect = Effect::none;
  setting.knob.clear();
  setting.note = std::move(note);
}

void set_outside(Reading& reading, const Found& found, std::string note) {
  Setting& setting = reading.setting_of(found);
  setting.effect = Effect::outside;
  setting.knob.clear();
  setting.note = std::move(note);
  add_remark(reading.profile, Severity::error, "fastdds.outside", found.value.place,
             fmt::format("{} = {}: {}; the model cannot describe this system", setting.path,
                         quote(setting.value), setting.note));
}

void interpret_announcements(Reading& reading) {
  interpret_startup(reading);
  interpret_lease(reading);
}

void interpret_participant(Reading& reading) {
  const bool is_client = interpret_client(reading);
  interpret_protocol(reading, is_client);
  interpret_throughput(reading);
  interpret_ports(reading);
  interpret_peers(reading, is_client);
  interpret_properties(reading);
}

}  // namespace stormproof::model::config::vendor::fastdds
