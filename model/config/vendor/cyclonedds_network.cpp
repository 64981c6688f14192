// Multicast, transport and interfaces: what several settings of Cyclone DDS decide together about
// the ways that announcements and descriptors take.
#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "model/config/vendor/addresses.hpp"
#include "model/config/vendor/any_case.hpp"
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
    apply_peers();
    apply_words();
    if (settings_.announcing() == Announcing::nowhere) return apply_silence();
    if (settings_.announcing() == Announcing::somewhere) {
      const CycloneReading& cause = *settings_.silencer();
      setting(cause).effect = Effect::unmodelled;
      assume(profile_, "announcements on some interfaces", cause.place,
             "not all interfaces announce by multicast; the model has one, which does");
    }
    look_at_reception();
  }

  void apply_peers() {
    if (settings_.peers.empty()) return;
    std::string addresses;
    for (const CycloneReading& peer : settings_.peers) {
      addresses += fmt::format("{}{}", addresses.empty() ? "" : ", ", peer.shown);
      look_at_peer(peer);
    }
    const CycloneReading& first = settings_.peers.front();
    if (const auto ports = modelled_ports()) {
      (void)set_path(profile_.changes, "peers",
                     Node::scalar(first.place, fmt::format("{}", *ports)));
      for (const CycloneReading& peer : settings_.peers) {
        setting(peer).effect = Effect::knob;
        setting(peer).knob = "peers";
        setting(peer).note = fmt::format(
            "announcements go to {} ports of it; in the model, of every other host", *ports);
      }
      return;
    }
    assume(profile_, first.option->path, first.place,
           fmt::format("{}; {}", addresses, first.option->note));
  }

  /// Ports of each peer, if the model has as many.
  [[nodiscard]] std::optional<std::int64_t> modelled_ports() const {
    constexpr std::int64_t most = 1'000;
    const auto ports = settings_.ports_of_peers();
    return ports && *ports <= most ? ports : std::nullopt;
  }

  /// Addresses stand with commas between them; the first that is none ends the list
  /// (add_addresses_to_addrset in q_addrset.c), and the process from 11 on
  /// (ddsi_spdp_scheduler_new).
  void look_at_peer(const CycloneReading& peer) {
    const std::string why = why_no_peer(peer);
    if (why.empty()) return;
    const bool ends_process = settings_.version == CycloneVersion::of_11;
    setting(peer).note = "not a valid address";
    remark(ends_process ? Severity::error : Severity::warning, "peer-address", peer.place,
           fmt::format(
               "Peer Address {}: not a valid address ({}); {}", quote(peer.value.word), why,
               ends_process ? "Cyclone DDS 11 ends the process" : "nobody there is announced to"),
           "write the address of the peer's host, or leave the Peer out");
  }
  static std::string why_no_peer(const CycloneReading& peer) {
    std::string_view rest = peer.value.word;
    for (;;) {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      std::string why = why_no_endpoint(rest.substr(0, comma));
      if (!why.empty() || comma == rest.size()) return why;
      rest.remove_prefix(comma + 1);
    }
  }
  /// Whether an address of the peer comes before one that is none.
  static bool leads_somewhere(const CycloneReading& peer) {
    const std::string_view list = peer.value.word;
    return why_no_endpoint(list.substr(0, list.find(','))).empty();
  }

  /// What AllowMulticast says; of 11 it holds for interfaces that say nothing themselves.
  void apply_words() {
    constexpr std::string_view path = "General/AllowMulticast";
    const CycloneReading* allow = settings_.find(path);
    const std::string words = settings_.value(path).word;
    const auto has = [&](std::string_view word) { return words.find(word) != std::string::npos; };
    const bool sedp = has("asm") || has("ssm") || has("true");
    const bool announces = settings_.announcing() != Announcing::nowhere;
    const bool only_to_peers = !announces && modelled_ports();
    std::string knob = only_to_peers ? "false" : sedp && announces ? "true" : "spdp";
    std::string what = sedp ? "what has several readers goes by multicast, as here"
                            : "SEDP goes by unicast, as here";
    if (has("default") && announces) {
      knob = "default";
      what = "on a wired network SEDP goes by multicast, on Wi-Fi by unicast, as here";
    }
    if (allow == nullptr && announces) return;
    const CycloneReading* cause = allow != nullptr ? allow : settings_.silencer();
    (void)set_path(profile_.changes, "allow_multicast",
                   Node::scalar(cause->place, std::move(knob)));
    if (allow == nullptr) return;
    setting(*allow).effect = Effect::knob;
    setting(*allow).note = std::move(what);
  }

  /// No announcement goes by multicast: there must be peers, and ports that they can guess.
  void apply_silence() {
    const CycloneReading& cause = *settings_.silencer();
    const std::string what = fmt::format("{} {}", cause.option->path, cause.shown);
    if (modelled_ports()) {
      setting(cause).effect = Effect::knob;
      setting(cause).knob = "allow_multicast";
      setting(cause).note = "announcements go to the peers alone, by unicast, as here";
    } else {
      const std::string_view note =
          "announcements go to the peers alone, by unicast; the model sends them by multicast";
      setting(cause).effect = Effect::unmodelled;
      setting(cause).note = note;
      assume(profile_, cause.option->path, cause.place, fmt::format("{}; {}", cause.shown, note));
    }
    if (std::ranges::none_of(settings_.peers, leads_somewhere)) {
      setting(cause).effect = Effect::outside;
      remark(Severity::error, "no-announcements", cause.place,
             fmt::format("{} without {}: no announcement leaves the host, so nobody on other hosts "
                         "is found",
                         what, settings_.peers.empty() ? "peers" : "the address of a peer"),
             "add Discovery/Peers, or let announcements go by multicast (spdp)");
    } else if (settings_.participant_index() == "none") {
      remark(Severity::warning, "participant-index", cause.place,
             fmt::format("{} with ParticipantIndex none: peers cannot know the ports of this host",
                         what),
             "set Discovery/ParticipantIndex to auto");
    }
  }

  /// Announcements go out, but nobody with this file listens to the group.
  void look_at_reception() {
    const CycloneReading* heard = settings_.find("General/MulticastRecvNetworkInterfaceAddresses");
    if (heard == nullptr || !is_same_word(heard->value.word, "none")) return;
    if (std::ranges::any_of(settings_.peers, leads_somewhere)) return;
    setting(*heard).effect = Effect::outside;
    remark(Severity::error, "no-announcements", heard->place,
           "MulticastRecvNetworkInterfaceAddresses none: no announcement is heard, so nobody on "
           "other hosts is found",
           "leave it out, or add Discovery/Peers");
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
        profile_, "General/Interfaces", settings_.interfaces[1].place,
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
