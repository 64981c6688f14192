// Members of the groups that announcements go to, and queriers.
#include "checker/evidence/doctor/reasons/listeners.hpp"

#include <set>
#include <vector>

#include <fmt/format.h>

#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::doctor {

namespace {

using capture::Address;

/// The groups that participants announce themselves to.
std::set<Address> groups(const capture::Conversation& conversation) {
  std::set<Address> found;
  for (const capture::Event& event : conversation.events) {
    if (event.is_multicast && event.traffic() == capture::Traffic::spdp) {
      found.insert(conversation.datagrams[event.datagram].destination.address);
    }
  }
  return found;
}

}  // namespace

Listeners listeners(const Contacts& contacts) {
  const capture::Conversation& conversation = contacts.conversation();
  std::set<Address> heard;
  for (const capture::Participant& one : contacts.topology().participants) {
    heard.insert(one.addresses.begin(), one.addresses.end());
  }
  Listeners result;
  for (const Address& group : groups(conversation)) {
    const auto members = conversation.igmp.members.find(group);
    if (members == conversation.igmp.members.end()) continue;
    std::vector<std::string> silent;
    for (const Address& member : members->second) {
      if (!heard.contains(member)) silent.push_back(to_string(member));
    }
    if (silent.empty()) continue;
    result.others_listen = true;
    result.text +=
        fmt::format("; {} {} joined {} (IGMP), so somebody listens there", fmt::join(silent, ", "),
                    silent.size() == 1 ? "has" : "have", to_string(group));
  }
  // Listeners are asked every 125 s and forgotten after 260 s (RFC 3376, sections 8.2 and 8.4).
  constexpr std::int64_t forgotten_after_ns = 260'000'000'000;
  constexpr std::int64_t second_ns = 1'000'000'000;
  const std::int64_t captured_ns = conversation.last_ns - conversation.first_ns;
  if (!conversation.igmp.queriers.empty()) {
    result.text += fmt::format("; {} asks who listens (IGMP), so snooping is not without a querier",
                               to_string(*conversation.igmp.queriers.begin()));
  } else if (captured_ns >= forgotten_after_ns) {
    result.text += fmt::format(
        "; nobody asked who listens (IGMP) within {}, so a switch with snooping has forgotten its "
        "listeners",
        report::plural(static_cast<std::uint64_t>(captured_ns / second_ns), "second"));
  }
  return result;
}

}  // namespace stormproof::doctor
