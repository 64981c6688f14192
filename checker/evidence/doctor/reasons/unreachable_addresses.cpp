// Answers go to the addresses that a participant announces. If these are those of a container's
// bridge, of loopback or of another network, they do not reach it.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "checker/evidence/doctor/reasons/addresses.hpp"
#include "checker/evidence/doctor/reasons/reasons.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::doctor {

namespace {

/// Of one participant: what it announces, if none of it is where its packets come from.
std::set<capture::Address> announced_elsewhere(const capture::Participant& one) {
  std::set<capture::Address> announced;
  for (const capture::UdpEnd& locator : one.locators) announced.insert(locator.address);
  const bool is_known = std::ranges::any_of(
      announced, [&](const capture::Address& address) { return one.addresses.contains(address); });
  if (is_known || one.addresses.empty()) announced.clear();
  return announced;
}

}  // namespace

void unreachable_addresses(const Contacts& contacts, std::vector<Reason>& found) {
  // By host: what its participants announce, and how many do.
  std::map<std::size_t, std::pair<std::set<capture::Address>, std::size_t>> elsewhere;
  const auto& list = contacts.topology().participants;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const auto announced = announced_elsewhere(list[k]);
    const bool sends_locally = std::ranges::all_of(list[k].addresses, is_loopback);
    if (announced.empty() || sends_locally || contacts.of(k).announced.empty()) continue;
    auto& [addresses, participants] = elsewhere[list[k].host];
    addresses.insert(announced.begin(), announced.end());
    ++participants;
  }
  for (const auto& [host, what] : elsewhere) {
    const auto& [addresses, participants] = what;
    std::vector<std::string> texts;
    for (const capture::Address& one : addresses) texts.push_back(to_string(one));
    const bool is_loopback_only = std::ranges::all_of(addresses, is_loopback);
    const bool is_bridge = std::ranges::any_of(addresses, is_container_bridge);
    const bool is_other_network = std::ranges::none_of(addresses, [&](const auto& one) {
      return std::ranges::any_of(list, [&](const capture::Participant& other) {
        return std::ranges::any_of(other.addresses, [&](const capture::Address& known) {
          return share_a_network(one, known);
        });
      });
    });
    const char* const why = is_loopback_only ? "the loopback, which no other host reaches"
                            : is_bridge      ? "a container's bridge, which only its host reaches"
                            : is_other_network
                                ? "another network than that in which its packets are seen"
                                : "not where its packets come from";
    found.push_back(
        {"unreachable",
         fmt::format("{} of {} announce {} and nothing else: that is {}. Answers go there",
                     report::plural(participants, "participant"), contacts.host_text(host),
                     fmt::join(texts, ", "), why),
         is_loopback_only || is_bridge ? 0.95 : 0.8,
         is_bridge ? "run the container with --network host, or give it an address of the network "
                     "(macvlan); or a Discovery Server that both reach"
                   : "name the interface that the others reach (interfaceWhiteList of Fast DDS, "
                     "<Interfaces> of Cyclone DDS)"});
  }
}

}  // namespace stormproof::doctor
