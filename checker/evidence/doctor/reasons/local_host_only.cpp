// ROS_LOCALHOST_ONLY=1, or a discovery range of LOCALHOST: participants send over the loopback
// alone, or with a time to live of 0, which no packet leaves its host with.
#include <algorithm>

#include <fmt/format.h>

#include "checker/evidence/doctor/reasons/addresses.hpp"
#include "checker/evidence/doctor/reasons/reasons.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::doctor {

void local_host_only(const Contacts& contacts, std::vector<Reason>& found) {
  const auto& list = contacts.topology().participants;
  std::size_t locals = 0;
  std::size_t without_range = 0;
  for (const capture::Participant& one : list) {
    const bool from_loopback =
        !one.addresses.empty() && std::ranges::all_of(one.addresses, is_loopback);
    const bool at_loopback = std::ranges::all_of(
        one.locators, [](const capture::UdpEnd& locator) { return is_loopback(locator.address); });
    if (from_loopback && at_loopback) ++locals;
  }
  std::set<capture::Address> stays;
  std::set<capture::Address> leaves;
  for (const capture::DatagramRecord& one : contacts.conversation().datagrams) {
    if (!one.destination.address.is_multicast()) continue;
    (one.time_to_live == 0 ? stays : leaves).insert(one.source.address);
  }
  for (const capture::Participant& one : list) {
    const bool here = std::ranges::any_of(
        one.addresses, [&](const auto& address) { return stays.contains(address); });
    const bool away = std::ranges::any_of(
        one.addresses, [&](const auto& address) { return leaves.contains(address); });
    if (here && !away) ++without_range;
  }
  if (locals + without_range == 0) return;
  const bool all = locals + without_range >= list.size();
  found.push_back(
      {"localhost_only",
       locals > 0
           ? fmt::format(
                 "{} of {} send from the loopback and announce nothing but it: they are seen "
                 "on their own host only",
                 locals, report::plural(list.size(), "participant"))
           : fmt::format("{} of {} announce themselves with a time to live of 0, so these packets "
                         "never leave their host",
                         without_range, report::plural(list.size(), "participant")),
       all ? 0.95 : 0.9,
       "ROS_LOCALHOST_ONLY unset or 0, ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET (the words are in "
       "capitals; another word means LOCALHOST)"});
}

}  // namespace stormproof::doctor
