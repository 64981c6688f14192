// The way back: a profile as a file that its vendor's library reads. Only elements that change
// something are written, each with a comment that says what it does to discovery; reading the file
// on top of the same preset gives the profile back.
#include <algorithm>

#include <fmt/core.h>

#include "model/config/knobs/effective.hpp"
#include "model/config/knobs/numeric_knobs.hpp"
#include "model/config/knobs/value_json.hpp"
#include "model/config/tree/quantities.hpp"
#include "model/config/tree/tree.hpp"
#include "model/config/vendor/cyclonedds_values.hpp"
#include "model/config/vendor/fastdds_schema.hpp"
#include "model/config/vendor/vendor_knobs.hpp"

namespace stormproof::model::config::vendor {
namespace {

/// Every value of a profile by its dotted key, as JSON text.
using Values = std::map<std::string, std::string, std::less<>>;

void flatten(const Json& json, const std::string& prefix, Values& values) {
  for (const auto& [key, value] : json.items()) {
    if (value.is_object()) {
      flatten(value, prefix + key + ".", values);
    } else {
      values[prefix + key] = value.dump();
    }
  }
}

/// Without the assumptions, which are no knobs.
Values values_of(DdsProfile profile) {
  profile.unmodelled.clear();
  Values values;
  flatten(effective_json(profile), "", values);
  return values;
}

std::string shown(const Values& values, std::string_view key) {
  const auto found = values.find(key);
  return found == values.end() ? "nothing" : found->second;
}

/// A JSON text without its quotes.
std::string trimmed_quotes(const std::string& value) {
  return value.starts_with("\"") ? value.substr(1, value.size() - 2) : value;
}

/// The knobs to write, with their numbers; an error if one of them cannot be written.
class Changes {
 public:
  Changes(Vendor vendor, std::string_view preset, const DdsProfile& base,
          const DdsProfile& profile) {
    if (base.unmodelled != profile.unmodelled) {
      fail(preset, "unmodelled",
           "differs from the preset's; expected the same: what the model has "
           "not is not written");
    }
    discovery_ = profile.discovery;
    servers_by_address_ =
        vendor == Vendor::fastdds && fastdds::version_of(preset) >= fastdds::servers_by_address;
    const Values after = values_of(profile);
    Values before = values_of(base);
    if (base.discovery != profile.discovery) {  // what the preset has, if it discovered that way
      const std::string way = shown(before, "discovery");
      DdsProfile same = base;
      same.discovery = profile.discovery;
      const ServerProfile own = same.server;
      same.server = profile.server;  // the rules of the version's server, which no user chooses
      same.server.client_sync_period = own.client_sync_period;
      same.server.server_routine_period = own.server_routine_period;
      before = values_of(same);
      before["discovery"] = way;
      if (profile.discovery == Discovery::simple) {
        fail(preset, "discovery", "simple: expected another preset, which discovers that way");
      }
    }
    for (const VendorKnob& knob : vendor_knobs(vendor)) {
      const std::string old_value = shown(before, knob.key), value = shown(after, knob.key);
      if (old_value == value) continue;
      const bool is_idle = vendor == Vendor::fastdds && profile.spdp.startup_announcements == 0;
      if (knob.key == "spdp.startup_period" && is_idle) {
        fail(preset, knob.key,
             fmt::format("{}: does nothing without startup announcements; expected {}, as the "
                         "preset has it",
                         value, old_value));
      }
      if (knob.is_choice())
        words_.emplace(knob.key, trimmed_quotes(value));
      else
        add(vendor, preset, knob, numeric_knob(profile, knob.key), value);
    }
  }

  /// Null if it stays as it is.
  [[nodiscard]] const std::int64_t* find(std::string_view key) const {
    const auto found = numbers_.find(key);
    return found == numbers_.end() ? nullptr : &found->second;
  }
  /// A duration that is no knob to search, in ns.
  [[nodiscard]] std::optional<std::int64_t> duration(std::string_view key) const {
    const std::string* text = word(key);
    const auto parsed = text == nullptr ? std::nullopt : std::optional{parse_duration(*text)};
    if (!parsed || !*parsed) return std::nullopt;
    return (*parsed)->count();
  }
  /// The number of participants of a host that changes.
  [[nodiscard]] std::optional<std::int64_t> participants_of_a_host() const {
    const std::string* text = word("max_participants_per_host");
    const auto parsed = text == nullptr ? std::nullopt : std::optional{parse_count(*text)};
    if (!parsed || !*parsed) return std::nullopt;
    return **parsed;
  }
  /// The word of a choice that changes, or null.
  [[nodiscard]] const std::string* word(std::string_view key) const {
    const auto found = words_.find(key);
    return found == words_.end() ? nullptr : &found->second;
  }
  [[nodiscard]] bool has_any(std::string_view prefix) const {
    return std::ranges::any_of(numbers_,
                               [&](const auto& entry) { return entry.first.starts_with(prefix); });
  }
  [[nodiscard]] const std::optional<InputError>& error() const { return error_; }
  /// Of the profile, whether or not it changes.
  [[nodiscard]] Discovery discovery() const { return discovery_; }
  [[nodiscard]] bool has_servers_by_address() const { return servers_by_address_; }
  [[nodiscard]] bool has_server() const {
    return discovery_ == Discovery::server || discovery_ == Discovery::super_client;
  }

 private:
  void fail(std::string_view preset, std::string_view key, std::string message) {
    if (!error_) {
      error_ = InputError{fmt::format("XML for {}", preset), fmt::format("{} {}", key, message)};
    }
  }

  void add(Vendor vendor, std::string_view preset, const VendorKnob& knob,
           std::optional<std::int64_t> number, const std::string& value) {
    if (knob.setting.empty()) {
      fail(preset, knob.key,
           fmt::format("{}: no user of {} can set it ({})", value, name_of(vendor), knob.why));
    } else if (!number) {
      fail(preset, knob.key, fmt::format("{}: is no number; expected a numeric knob", value));
    } else if (*number < knob.minimum || *number > knob.maximum) {
      fail(preset, knob.key,
           fmt::format("{}: expected {} to {} (ns or B), which {} can set", value, knob.minimum,
                       knob.maximum, knob.setting));
    }
    if (number) numbers_.emplace(knob.key, *number);
  }

  std::map<std::string_view, std::int64_t> numbers_;
  std::map<std::string_view, std::string> words_;
  std::optional<InputError> error_;
  Discovery discovery_{};
  bool servers_by_address_ = false;
};

/// Text with line breaks and indentation.
class XmlWriter {
 public:
  explicit XmlWriter(const std::string& comment) {
    text_ = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    if (!comment.empty()) text_ += fmt::format("<!-- {} -->\n", in_comment(comment));
  }

  /// `tag` with its attributes.
  void open(const std::string& tag) {
    line("<" + tag + ">");
    open_.push_back(tag.substr(0, tag.find(' ')));
  }
  void close() {
    const std::string tag = open_.back();
    open_.pop_back();
    line("</" + tag + ">");
  }
  void comment(const std::string& words) { line("<!-- " + in_comment(words) + " -->"); }
  void leaf(const std::string& tag, const std::string& value) { leaf(tag, tag, value); }
  /// `begin` is the tag with its attributes.
  void leaf(const std::string& begin, const std::string& tag, const std::string& value) {
    line(fmt::format("<{}>{}</{}>", begin, value, tag));
  }
  [[nodiscard]] std::string text() {
    while (!open_.empty()) close();
    return text_;
  }

 private:
  /// A comment must not hold "--" nor end in '-'; control characters are not XML.
  static std::string in_comment(const std::string& words) {
    std::string safe;
    for (const char c : words) {
      if (c == '-' && safe.ends_with('-')) safe += ' ';
      safe += static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' ? ' ' : c;
    }
    return safe;
  }
  void line(const std::string& words) {
    text_ += fmt::format("{:{}}{}\n", "", 2 * open_.size(), words);
  }

  std::string text_;
  std::vector<std::string> open_;
};

void write_duration(XmlWriter& xml, const std::string& tag, std::int64_t ns) {
  xml.open(tag);
  xml.leaf("sec", fmt::format("{}", ns / second_ns));
  xml.leaf("nanosec", fmt::format("{}", ns % second_ns));
  xml.close();
}

constexpr const char* server_prefix = "44.53.00.5f.45.50.52.4f.53.49.4d.41";  // of server 0
constexpr const char* some_address = "192.0.2.1";                             // RFC 5737: nobody's
constexpr const char* server_port = "11811";

void write_locator(XmlWriter& xml, bool has_port) {
  xml.open("locator");
  xml.open("udpv4");
  xml.leaf("address", some_address);
  if (has_port) xml.leaf("port", server_port);
  xml.close();
  xml.close();
}

/// A client names its server, and how often it looks for it.
void write_client(XmlWriter& xml, const Changes& changes) {
  const bool is_super = changes.discovery() == Discovery::super_client;
  xml.comment(is_super ? "is told of every endpoint"
                       : "is told of the endpoints that match its own");
  xml.leaf("discoveryProtocol", is_super ? "SUPER_CLIENT" : "CLIENT");
  if (const std::int64_t* period = changes.find("client_sync_period")) {
    xml.comment("until a client matches its endpoints with the server's");
    write_duration(xml, "clientAnnouncementPeriod", *period);
  }
  xml.open("discoveryServersList");
  if (changes.has_servers_by_address()) {
    xml.comment("the address of your server");
    write_locator(xml, true);
    xml.close();
    return;
  }
  xml.open(fmt::format("RemoteServer prefix=\"{}\"", server_prefix));
  xml.open("metatrafficUnicastLocatorList");
  xml.comment("the address of your server");
  write_locator(xml, true);
  xml.close();
  xml.close();
  xml.close();
}

/// The server's own profile, which is not the default one.
void write_server(XmlWriter& xml, std::int64_t routine_period) {
  xml.open("participant profile_name=\"server\"");
  xml.open("rtps");
  xml.leaf("prefix", server_prefix);
  xml.open("builtin");
  xml.open("discovery_config");
  xml.leaf("discoveryProtocol", "SERVER");
  xml.comment("until the server looks again who has acknowledged what");
  write_duration(xml, "clientAnnouncementPeriod", routine_period);
  xml.close();
  xml.open("metatrafficUnicastLocatorList");
  xml.comment("its own address");
  write_locator(xml, true);
  xml.close();
  xml.close();
  xml.close();
  xml.close();
}

void write_fastdds_discovery(XmlWriter& xml, const Changes& changes) {
  const bool has_peers = changes.discovery() == Discovery::static_peers;
  const auto lease = changes.duration("spdp.lease");
  const auto participants = changes.participants_of_a_host();
  const bool has_config = changes.has_any("spdp.") || lease || changes.has_server();
  if (!has_config && !has_peers && !participants) return;
  xml.open("builtin");
  if (participants) {
    xml.comment("ports that a participant tries after its first");
    xml.leaf("mutation_tries", fmt::format("{}", *participants - 1));
  }
  if (has_config) xml.open("discovery_config");
  if (changes.has_server()) write_client(xml, changes);
  const std::int64_t* count = changes.find("spdp.startup_announcements");
  const std::int64_t* startup = changes.find("spdp.startup_period");
  if (count != nullptr || startup != nullptr) {
    xml.comment("announcements after the first one, and the time between them");
    xml.open("initialAnnouncements");
    if (count != nullptr) xml.leaf("count", fmt::format("{}", *count));
    if (startup != nullptr) write_duration(xml, "period", *startup);
    xml.close();
  }
  if (lease) {
    xml.comment("how long others remember a participant of which they hear nothing");
    write_duration(xml, "leaseDuration", *lease);
  }
  if (const std::int64_t* period = changes.find("spdp.period")) {
    xml.comment("time between announcements from then on");
    write_duration(xml, "leaseAnnouncement", *period);
  }
  if (has_config) xml.close();
  if (has_peers) {
    xml.comment("one locator for the address of each host, without a port");
    xml.open("initialPeersList");
    write_locator(xml, false);
    xml.close();
  }
  xml.close();
}

/// The transport of what a transport says, and no other.
void write_transport(XmlWriter& xml, const std::int64_t* buffer, const std::int64_t* ports) {
  xml.open("transport_descriptors");
  xml.open("transport_descriptor");
  xml.leaf("transport_id", "udp");
  xml.leaf("type", "UDPv4");
  if (buffer != nullptr) {
    xml.comment(
        "a writer adds a HEARTBEAT to its DATA each time it has sent this much; Linux has "
        "to allow it (net.core.wmem_max)");
    xml.leaf("sendBufferSize", fmt::format("{}", *buffer));
  }
  if (ports != nullptr) {
    xml.comment("participants of a host that an announcement is sent to");
    xml.leaf("maxInitialPeersRange", fmt::format("{}", *ports));
  }
  xml.close();
  xml.close();
}

void write_property(XmlWriter& xml, const std::string& name, const std::string& value) {
  xml.open("property");
  xml.leaf("name", name);
  xml.leaf("value", value);
  xml.close();
}

std::string write_fastdds(const Changes& changes, const std::string& comment) {
  XmlWriter xml{comment};
  const std::int64_t* buffer = changes.find("sedp.piggyback_threshold_bytes");
  const std::int64_t* message = changes.find("sedp.grouping_limit_bytes");
  const std::string* lookup = changes.word("type_lookup");
  xml.open("profiles xmlns=\"http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles\"");
  const std::int64_t* ports = changes.find("peer_ports");
  if (buffer != nullptr || ports != nullptr) write_transport(xml, buffer, ports);
  if (const std::int64_t* period = changes.find("server_routine_period")) {
    write_server(xml, *period);
  }
  xml.open("participant profile_name=\"stormproof\" is_default_profile=\"true\"");
  xml.open("rtps");
  write_fastdds_discovery(xml, changes);
  if (message != nullptr || lookup != nullptr) {
    xml.open("propertiesPolicy");
    xml.open("properties");
    if (message != nullptr) {
      xml.comment("largest message with pulled and repair DATA");
      write_property(xml, "fastdds.max_message_size", fmt::format("{}", *message));
    }
    if (lookup != nullptr) {
      xml.comment("whether participants ask for the types of others");
      write_property(xml, "fastdds.type_propagation",
                     *lookup == "true" ? "enabled" : "registration_only");
    }
    xml.close();
    xml.close();
  }
  if (buffer != nullptr || ports != nullptr) {
    xml.comment(buffer == nullptr
                    ? "this transport alone"
                    : "the buffer of a participant is ignored with user transports, and the "
                      "segment of shared memory would bound the threshold: this transport alone");
    xml.open("userTransports");
    xml.leaf("transport_id", "udp");
    xml.close();
    xml.leaf("useBuiltinTransports", "false");
  }
  return xml.text();
}

/// HeartbeatInterval where only its maximum changes: the default of the library, which presets
/// have.
constexpr std::int64_t usual_interval_ns = 100'000'000;

void write_cyclone_discovery(XmlWriter& xml, const Changes& changes) {
  constexpr std::int64_t default_bound = 8 * second_ns;
  const std::int64_t* period = changes.find("spdp.period");
  std::optional<std::int64_t> lease = changes.duration("spdp.lease");
  const auto participants = changes.participants_of_a_host();
  const auto initial = changes.duration("spdp.initial_prune_delay");
  const auto discovered = changes.duration("spdp.discovered_prune_delay");
  if (period == nullptr && !lease && !participants && !initial && !discovered) return;
  xml.open("Discovery");
  if (period != nullptr) {
    xml.comment("time between announcements");
    xml.leaf("SPDPInterval", print_cyclone_duration(*period));
    if (!lease && *period > default_bound) lease = *period + 2 * second_ns;
  }
  if (lease) {
    xml.comment("announcements go out 2 s before the lease ends, or earlier");
    xml.leaf("LeaseDuration", print_cyclone_duration(*lease));
  }
  if (participants) {
    xml.comment("processes of a host that find an index");
    xml.leaf("ParticipantIndex", "auto");
    xml.leaf("MaxAutoParticipantIndex", fmt::format("{}", *participants));
  }
  if (initial || discovered) {
    xml.comment("of 11.0 and later: how long addresses at which nobody is known are announced to");
  }
  if (initial) xml.leaf("InitialLocatorPruneDelay", print_cyclone_duration(*initial));
  if (discovered) xml.leaf("DiscoveredLocatorPruneDelay", print_cyclone_duration(*discovered));
  xml.close();
}

void write_cyclone_general(XmlWriter& xml, const Changes& changes) {
  const std::string* multicast = changes.word("allow_multicast");
  const std::int64_t* size = changes.find("sedp.max_message_size");
  const std::int64_t* repairs = changes.find("sedp.max_rexmit_message_size");
  if (multicast == nullptr && size == nullptr && repairs == nullptr) return;
  xml.open("General");
  if (multicast != nullptr) {
    xml.comment("what goes by multicast: all that has several receivers, or announcements");
    xml.leaf("AllowMulticast", *multicast);
  }
  if (size != nullptr) {
    xml.comment("largest packet without repairs");
    xml.leaf("MaxMessageSize", fmt::format("{} B", *size));
  }
  if (repairs != nullptr) {
    xml.comment("largest packet with repairs");
    xml.leaf("MaxRexmitMessageSize", fmt::format("{} B", *repairs));
  }
  xml.close();
}

void write_cyclone_internal(XmlWriter& xml, const Changes& changes) {
  struct Delay {
    const char *key, *tag, *comment;
  };
  constexpr Delay delays[] = {
      {"sedp.nack_delay", "NackDelay", "how long the same descriptors are not asked for again"},
      {"sedp.ack_delay", "AckDelay", "how long the same ACK is not repeated"},
      {"sedp.auto_resched_nack_delay", "AutoReschedNackDelay",
       "after that a reader asks again by itself"},
      {"sedp.preemptive_ack_delay", "PreEmptiveAckDelay", "until the first pre-emptive ACKNACK"}};
  const std::int64_t* interval = changes.find("sedp.heartbeat_interval");
  const std::int64_t* most = changes.find("sedp.heartbeat_interval_max");
  const std::int64_t* queued = changes.find("sedp.max_queued_rexmit_messages");
  const bool has_delay =
      std::ranges::any_of(delays, [&](const Delay& d) { return changes.find(d.key) != nullptr; });
  if (interval == nullptr && most == nullptr && queued == nullptr && !has_delay) return;
  xml.open("Internal");
  if (interval != nullptr || most != nullptr) {
    xml.comment("interval of HEARTBEATs, which doubles and stays below the maximum");
    std::string tag = "HeartbeatInterval";
    if (most != nullptr) tag += fmt::format(" max=\"{}\"", print_cyclone_duration(*most));
    xml.leaf(tag, "HeartbeatInterval",
             print_cyclone_duration(interval != nullptr ? *interval : usual_interval_ns));
  }
  for (const Delay& delay : delays) {
    const std::int64_t* ns = changes.find(delay.key);
    if (ns == nullptr) continue;
    xml.comment(delay.comment);
    xml.leaf(delay.tag, print_cyclone_duration(*ns));
  }
  if (queued != nullptr) {
    xml.comment("requests beyond that many queued repairs are dropped");
    xml.leaf("MaxQueuedRexmitMessages", fmt::format("{}", *queued));
  }
  xml.close();
}

std::string write_cyclonedds(const Changes& changes, const std::string& comment) {
  XmlWriter xml{comment};
  xml.open("CycloneDDS xmlns=\"https://cdds.io/config\"");
  xml.open("Domain Id=\"any\"");
  write_cyclone_general(xml, changes);
  write_cyclone_discovery(xml, changes);
  if (changes.has_any("sedp.")) write_cyclone_internal(xml, changes);
  return xml.text();
}

}  // namespace

Result<std::string> write_vendor_xml(Vendor vendor, std::string_view preset, const DdsProfile& base,
                                     const DdsProfile& profile, const std::string& comment) {
  const std::optional<Vendor> owner = vendor_of_preset(preset);
  if (owner != vendor) {
    return InputError{fmt::format("XML for {}", preset),
                      fmt::format("{} is no preset of {}", quote(preset), name_of(vendor))};
  }
  const Changes changes{vendor, preset, base, profile};
  if (changes.error()) return *changes.error();
  return vendor == Vendor::fastdds ? write_fastdds(changes, comment)
                                   : write_cyclonedds(changes, comment);
}

}  // namespace stormproof::model::config::vendor
