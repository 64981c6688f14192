// Multicast, transport and interfaces: what several settings of Cyclone DDS decide together about
// the ways that announcements and descriptors take.
#include <fmt/core.h>

#include "model/config/vendor/cyclonedds_settings.hpp"

namespace stormproof::model::config::vendor {
namespace {

void drop_assumption(VendorProfile& profile, std::string_view key) {
  Node* map = profile.changes.find("unmodelled");
  if (map == nullptr) return;
  (void)map->take(key);
  if (map->members.empty()) (void)profile.changes.take("unmodelled");
}

class Network {
 public:
  Network(const CycloneSettings& settings, VendorProfile& profile)
      : settings_{settings}, profile_{profile} {}

  void apply() {
    apply_multicast();
    apply_transport();
    apply_loopback();
    apply_interfaces();
  }

 private:
  Setting& setting(const CycloneReading& reading) { return profile_.settings[reading.setting]; }

  void remark(Severity severity, std::string_view rule, const Place& place, std::string message,
              std::string hint = {}) {
    profile_.remarks.push_back(
        {severity, fmt::format("cyclonedds.{}", rule), place, std::move(message), std::move(hint)});
  }

  void apply_multicast() {
    constexpr std::string_view path = "General/AllowMulticast";
    if (!settings_.peers.empty()) {
      std::string addresses;
      for (const CycloneReading& peer : settings_.peers) {
        addresses += fmt::format("{}{}", addresses.empty() ? "" : ", ", peer.shown);
      }
      const CycloneReading& first = settings_.peers.front();
      assume(profile_, first.option->path, first.place,
             fmt::format("{}; {}", addresses, first.option->note));
    }
    const CycloneReading* allow = settings_.find(path);
    if (allow == nullptr) return;
    const std::string& words = allow->value.word;
    const auto has = [&](std::string_view word) { return words.find(word) != std::string::npos; };
    const bool announces = has("spdp") || has("true") || has("default");
    const bool sedp = has("asm") || has("ssm") || has("true");
    std::string what = "SEDP goes by unicast, as here";
    setting(*allow).effect = Effect::knob;
    if (has("default")) {
      what = "on a wired network SEDP goes by multicast, on Wi-Fi by unicast, as here";
      setting(*allow).effect = Effect::unmodelled;
    } else if (sedp) {
      what = "what has several readers goes by multicast, as here";
    }
    if (!announces) {
      what = "announcements go to the peers alone, by unicast; the model sends them by multicast";
      setting(*allow).effect = Effect::unmodelled;
      look_for_unicast_discovery(*allow);
    }
    setting(*allow).note = what;
    const bool multicast = sedp && announces;
    (void)set_path(profile_.changes, "allow_multicast",
                   Node::scalar(allow->place, multicast ? "true" : "spdp"));
    drop_assumption(profile_, path);  // it is a knob, and what `default` means stands in the preset
    if (!announces) {
      assume(profile_, path, allow->place, fmt::format("{}; {}", allow->shown, what));
    }
  }

  /// Without announcements by multicast there must be peers, and ports that they can guess.
  void look_for_unicast_discovery(const CycloneReading& allow) {
    if (settings_.peers.empty()) {
      setting(allow).effect = Effect::outside;
      remark(Severity::error, "no-announcements", allow.place,
             fmt::format("AllowMulticast {} without peers: no announcement leaves the host",
                         allow.shown),
             "add Discovery/Peers, or set spdp");
    } else if (settings_.participant_index() == "none") {
      remark(Severity::warning, "participant-index", allow.place,
             fmt::format("AllowMulticast {} with ParticipantIndex none: peers cannot know the "
                         "ports of this host",
                         allow.shown),
             "set Discovery/ParticipantIndex to auto");
    }
  }

  void apply_transport() {
    const CycloneReading* transport = settings_.find("General/Transport");
    if (transport != nullptr) {
      const std::string& word = transport->value.word;
      if (word == "tcp" || word == "tcp6" || word == "raweth" || word == "none") {
        setting(*transport).effect = Effect::outside;
        setting(*transport).note = "the model describes discovery over UDP";
        drop_assumption(profile_, "General/Transport");
        remark(Severity::error, "outside", transport->place,
               fmt::format("Transport {}: the model describes discovery over UDP", word));
      } else if (word == "udp") {
        setting(*transport).effect = Effect::none;
        setting(*transport).note = "the default, as in the model";
        drop_assumption(profile_, "General/Transport");
      }
    }
    const CycloneReading* ipv6 = settings_.find("General/UseIPv6");
    if (ipv6 != nullptr && ipv6->value.word == "false") {
      setting(*ipv6).effect = Effect::none;
      setting(*ipv6).note = "IPv4, as in the model";
      drop_assumption(profile_, "General/UseIPv6");
    }
    const CycloneReading* enabled = settings_.find("TCP/Enable");
    if (enabled == nullptr) return;
    if (enabled->value.word == "true") {
      remark(Severity::error, "outside", enabled->place,
             "TCP is enabled; the model describes discovery over UDP");
    } else {
      setting(*enabled).effect = Effect::none;
      setting(*enabled).note = "UDP, as in the model";
    }
  }

  /// The loopback interface as the only one: nothing leaves the host.
  void apply_loopback() {
    for (const char* path :
         {"General/Interfaces/NetworkInterface[@name]",
          "General/Interfaces/NetworkInterface[@address]", "General/NetworkInterfaceAddress"}) {
      const CycloneReading* reading = settings_.find(path);
      if (reading == nullptr || settings_.interfaces.size() > 1) continue;
      const std::string& word = reading->value.word;
      if (word != "lo" && word != "::1" && !word.starts_with("127.")) continue;
      setting(*reading).effect = Effect::outside;
      setting(*reading).note = "packets do not leave the host";
      remark(Severity::error, "outside", reading->place,
             fmt::format("{} {}: packets do not leave the host; the model cannot describe this "
                         "system",
                         path, word));
    }
  }

  void apply_interfaces() {
    if (settings_.interfaces.size() < 2) return;
    assume(
        profile_, "General/Interfaces", settings_.interfaces[1],
        fmt::format("{} network interfaces; announcements go out on each, and list the addresses "
                    "of all; the model has one",
                    settings_.interfaces.size()));
  }

  const CycloneSettings& settings_;
  VendorProfile& profile_;
};

}  // namespace

void apply_cyclone_network(const CycloneSettings& settings, VendorProfile& profile) {
  Network{settings, profile}.apply();
}

}  // namespace stormproof::model::config::vendor
