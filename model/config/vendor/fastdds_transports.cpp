// Which transports a Fast DDS participant uses, and whether discovery is then the one of the model:
// over UDP, between hosts. Builtin transports are UDPv4 and shared memory, unless the profile says
// otherwise; discovery does not go through shared memory (NetworkFactory.cpp:43-67,266-339).
#include <algorithm>

#include <fmt/core.h>

#include "model/config/vendor/fastdds_discovery.hpp"

namespace stormproof::model::config::vendor::fastdds {
namespace {

/// Transports that a participant registers.
struct Registered {
  bool builtin_udp = false;
  bool udp4 = false, udp6 = false, tcp = false, shm = false;
  const Found* choice = nullptr;  ///< the setting that made it so, if any
};

void register_builtin(Registered& registered, std::string_view choice) {
  const bool is_default = choice == "DEFAULT" || choice == "DEFAULTv6";
  const bool is_udp6 = choice == "DEFAULTv6" || choice == "UDPv6";
  registered.builtin_udp = is_default || choice == "UDPv4" || choice == "UDPv6";
  registered.udp4 = registered.builtin_udp && !is_udp6;
  registered.udp6 = is_udp6;
  registered.shm = is_default || choice == "SHM";
}

Registered register_transports(Reading& reading) {
  Registered registered;
  const Found* use = reading.section.find("rtps/useBuiltinTransports");
  const Found* builtin = reading.section.find("rtps/builtinTransports");
  const Found* user = reading.section.find("rtps/userTransports");
  if (builtin != nullptr) {
    register_builtin(registered, builtin->value.shown);
  } else if (use == nullptr || use->value.number != 0) {
    register_builtin(registered, "DEFAULT");
  }
  registered.choice = user != nullptr ? user : builtin != nullptr ? builtin : use;
  if (user == nullptr) return registered;
  for (const std::string& id : user->value.items) {
    const auto known = reading.transport_of_id.find(id);
    if (known == reading.transport_of_id.end()) {
      reading.setting_of(*user).effect = Effect::unknown;
      add_remark(reading.profile, Severity::error, "fastdds.unknown-transport", user->value.place,
                 fmt::format("no transport descriptor of this file has the id {}; the library "
                             "refuses the profile unless another file has defined it before",
                             quote(id)));
      continue;
    }
    Transport& transport = reading.transports[known->second];
    const Place& at = transport.element->place;
    if (std::pair{at.line, at.column} >
        std::pair{user->value.place.line, user->value.place.column}) {
      add_remark(reading.profile, Severity::error, "fastdds.transport-order", user->value.place,
                 fmt::format("transport {} is defined further down (line {}); the library reads "
                             "from top to bottom and does not find it",
                             quote(id), at.line),
                 "put <transport_descriptors> before the participants");
    }
    transport.is_used = true;
    registered.udp4 |= transport.type == "UDPv4";
    registered.udp6 |= transport.type == "UDPv6";
    registered.tcp |= transport.type.starts_with("TCP");
    registered.shm |= transport.type == "SHM";
  }
  return registered;
}

/// Whether discovery goes over UDP at all, and over what else.
void check_system(Reading& reading, const Registered& registered) {
  if (registered.choice == nullptr) return;
  const Found& choice = *registered.choice;
  if (choice.value.shown.starts_with("LARGE_DATA")) {
    return set_outside(reading, choice, "endpoints are discovered over TCP");
  }
  if (reading.setting_of(choice).effect == Effect::unknown) return;
  if (!registered.udp4 && !registered.udp6) {
    return set_outside(reading, choice,
                       registered.tcp   ? "discovery goes over TCP"
                       : registered.shm ? "discovery goes through shared memory only, so it does "
                                          "not leave the host"
                                        : "there is no transport at all");
  }
  std::string others;
  if (registered.tcp) others = "packets may go over TCP, too; the model has UDP only";
  if (registered.udp6) {
    others = registered.udp4
                 ? "packets may go over IPv6, too; the model has one address a participant"
                 : "IPv6 headers are 20 bytes longer than those that the model counts";
  }
  if (others.empty()) return;
  reading.setting_of(choice).effect = Effect::unmodelled;
  reading.setting_of(choice).note = others;
}

void check_transport(Reading& reading, const Transport& transport) {
  const Found* hops = transport.section.find("TTL");
  if (is_udp(transport) && hops != nullptr && hops->value.number == 0) {
    if (reading.section.find("rtps/builtin/initialPeersList") == nullptr) {
      set_outside(reading, *hops, "multicast announcements do not leave the host");
    }
  }
  const Found* list = transport.section.find("interfaceWhiteList");
  if (list == nullptr) return;
  if (list->value.items.empty()) return set_inert(reading, *list, "no address, no restriction");
  const bool is_loopback = std::ranges::all_of(list->value.items, [](const std::string& address) {
    return address.starts_with("127.") || address == "::1" || address == "lo";
  });
  if (is_loopback) set_outside(reading, *list, "packets do not leave the host");
}

void remark_unused(Reading& reading) {
  for (const Transport& transport : reading.transports) {
    if (transport.is_used) continue;
    for (const Found& found : transport.section.found) {
      set_inert(reading, found, "the profile does not use this transport");
    }
    if (transport.is_named) continue;
    add_remark(reading.profile, Severity::warning, "fastdds.unused-transport",
               transport.element->place,
               fmt::format("no <userTransports> names the transport {}, so nothing in it has an "
                           "effect",
                           quote(transport.id)));
  }
}

}  // namespace

void interpret_transports(Reading& reading) {
  const Registered registered = register_transports(reading);
  check_system(reading, registered);
  for (const Transport& transport : reading.transports) {
    if (transport.is_used) check_transport(reading, transport);
  }
  interpret_sizes(reading, registered.builtin_udp);
  remark_unused(reading);
}

}  // namespace stormproof::model::config::vendor::fastdds
