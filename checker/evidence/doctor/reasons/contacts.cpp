// One pass over the events.
#include "checker/evidence/doctor/reasons/contacts.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "checker/evidence/doctor/reasons/ports.hpp"
#include "checker/presentation/text/numbers.hpp"

namespace stormproof::doctor {

using capture::Event;
using capture::Traffic;

Contacts::Contacts(const capture::Conversation& conversation, const capture::Counting& counting)
    : conversation_{conversation}, counting_{counting} {
  const auto& list = topology().participants;
  all_.resize(list.size());
  hosts_.resize(topology().hosts);
  for (std::size_t k = 0; k < list.size(); ++k) {
    number_[list[k].prefix] = k;
    hosts_[list[k].host].push_back(k);
  }
  for (std::size_t k = 0; k < counting.classes.size(); ++k) add(conversation.events[k]);
  // Who is heard where is a matter of ports; what DATA(p) says counts where none tells it.
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (list[k].domain && all_[k].domains.empty()) all_[k].domains.insert(*list[k].domain);
  }
}

void Contacts::add(const Event& event) {
  const auto from = number_.find(event.source);
  if (from == number_.end()) return;
  Contact& sender = all_[from->second];
  sender.last_ns = std::max(sender.last_ns, event.time_ns);
  const capture::UdpEnd& end = conversation_.datagrams[event.datagram].destination;
  const bool is_sedp = event.traffic() == Traffic::sedp;
  if (const auto* data = event.data(); data != nullptr && event.traffic() == Traffic::spdp) {
    if (data->is_gone) sender.gone_ns = event.time_ns;
    if (!event.is_multicast) ++sender.directed;
    if (event.is_multicast && !data->is_gone) sender.announced.push_back(event.time_ns);
    const auto domain = domain_of_group(end.port);
    if (event.is_multicast && domain) sender.domains.insert(*domain);
  }
  if (!is_sedp && event.traffic() != Traffic::spdp) return;
  const auto to = event.destination ? number_.find(*event.destination) : number_.end();
  if (event.is_multicast) {
    if (is_sedp) ++sender.multicast_data;
    if (is_sedp) ++sender.answers;
  } else if (to == number_.end()) {
    if (is_sedp) ++unseen_[end];
  } else if (is_sedp && !event.is_same_host) {
    ++messages_[{from->second, to->second}];
    ++sender.answers;
    ++all_[to->second].told;
  }
}

std::uint64_t Contacts::messages(std::size_t from, std::size_t to) const {
  const auto found = messages_.find({from, to});
  return found == messages_.end() ? 0 : found->second;
}

std::optional<std::size_t> Contacts::number_of(const capture::GuidPrefix& prefix) const {
  const auto found = number_.find(prefix);
  return found == number_.end() ? std::nullopt : std::optional{found->second};
}

std::string Contacts::time_text(std::int64_t time_ns) const {
  return report::duration(model::Nanoseconds{time_ns - conversation_.first_ns});
}

std::string Contacts::host_text(std::size_t host) const {
  std::set<capture::Address> addresses;
  for (const std::size_t k : hosts_[host]) {
    addresses.insert(topology().participants[k].addresses.begin(),
                     topology().participants[k].addresses.end());
  }
  if (addresses.empty()) return fmt::format("host {}", host);
  return fmt::format("host {} ({}{})", host, to_string(*addresses.begin()),
                     addresses.size() > 1 ? ", …" : "");
}

std::string Contacts::text(std::size_t participant) const {
  return fmt::format("participant {} of {}", participant,
                     host_text(topology().participants[participant].host));
}

std::int64_t lease_of(const Contacts& contacts, std::size_t participant) {
  constexpr std::int64_t usual_ns = 20'000'000'000;
  return contacts.topology().participants[participant].lease_ns.value_or(usual_ns);
}

std::int64_t longest_pause_ns(const Contacts& contacts, std::size_t participant) {
  const std::vector<std::int64_t>& announced = contacts.of(participant).announced;
  std::int64_t longest_ns = 8'000'000'000;
  for (std::size_t k = 1; k < announced.size(); ++k) {
    // Announcements that an outage has swallowed do not count.
    const std::int64_t gap_ns = announced[k] - announced[k - 1];
    if (gap_ns < lease_of(contacts, participant) / 2) longest_ns = std::max(longest_ns, gap_ns);
  }
  return std::max(lease_of(contacts, participant) / 2, longest_ns + longest_ns / 10);
}

}  // namespace stormproof::doctor
