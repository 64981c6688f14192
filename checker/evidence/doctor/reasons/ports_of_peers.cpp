// Static peers: who announces itself to addresses instead of the group sends to some ports of each
// host, and a participant that listens on another port never hears of it.
#include <algorithm>

#include <fmt/format.h>

#include "checker/evidence/doctor/reasons/ports.hpp"
#include "checker/evidence/doctor/reasons/reasons.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::doctor {

namespace {

/// Hosts whose participants announce themselves to addresses and never to the group.
std::vector<std::size_t> hosts_with_peers(const Contacts& contacts) {
  std::vector<std::size_t> hosts;
  for (std::size_t h = 0; h < contacts.hosts().size(); ++h) {
    std::uint64_t directed = 0;
    std::uint64_t to_group = 0;
    for (const std::size_t k : contacts.hosts()[h]) {
      directed += contacts.of(k).directed;
      to_group += contacts.of(k).announced.size();
    }
    if (directed > 0 && to_group == 0) hosts.push_back(h);
  }
  return hosts;
}

}  // namespace

void ports_of_peers(const Contacts& contacts, std::vector<Reason>& found) {
  if (contacts.topology().has_server()) return;  // clients announce themselves to the server alone
  const auto& list = contacts.topology().participants;
  std::map<std::size_t, std::set<capture::UdpEnd>> reached;  // by sending host
  for (const capture::Event& event : contacts.conversation().events) {
    if (event.traffic() != capture::Traffic::spdp || event.is_multicast) continue;
    const capture::Participant* from = contacts.topology().find(event.source);
    if (from == nullptr) continue;
    reached[from->host].insert(contacts.conversation().datagrams[event.datagram].destination);
  }
  for (const std::size_t host : hosts_with_peers(contacts)) {
    const std::set<capture::UdpEnd>& ends = reached[host];
    std::set<std::uint16_t> ports;
    for (const capture::UdpEnd& end : ends) ports.insert(end.port);
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (list[k].host == host || list[k].locators.empty()) continue;
      const bool is_reached = std::ranges::any_of(
          list[k].locators, [&](const capture::UdpEnd& end) { return ends.contains(end); });
      const bool its_host_is = std::ranges::any_of(ends, [&](const capture::UdpEnd& end) {
        return std::ranges::any_of(list[k].addresses, [&](const capture::Address& address) {
          return address == end.address;
        });
      });
      if (is_reached || !its_host_is || ports.empty()) continue;
      found.push_back(
          {"peer_ports",
           fmt::format("{} announces itself to single ports of its peers ({} to {}) and never to "
                       "the group; {} listens on {}, which none of them is",
                       contacts.host_text(host), *ports.begin(), *ports.rbegin(), contacts.text(k),
                       list[k].locators.begin()->port),
           0.9,
           "fewer processes on that host, or more ports for each peer (maxInitialPeersRange of "
           "Fast "
           "DDS, <MaxAutoParticipantIndex> of Cyclone DDS, or the port behind the peer's "
           "address)"});
      break;  // one of them tells it
    }
  }
}

}  // namespace stormproof::doctor
