// Several hosts say that they are one machine. Only if they found nobody: without a list of
// interfaces it does no harm.
#include "checker/evidence/doctor/reasons/one_machine.hpp"

#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "checker/evidence/doctor/reasons/reasons.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::doctor {

std::vector<OneMachine> one_machines(const capture::Topology& topology) {
  std::map<std::string, std::set<std::size_t>> hosts;
  for (const capture::Participant& one : topology.participants) {
    if (!one.machine.empty()) hosts[one.machine].insert(one.host);
  }
  std::vector<OneMachine> found;
  for (auto& [identity, some] : hosts) {
    if (some.size() > 1) found.push_back({identity, std::move(some)});
  }
  return found;
}

void same_machine_id(const Contacts& contacts, std::vector<Reason>& found) {
  if (contacts.counting().required > 0) return;
  for (const OneMachine& one : one_machines(contacts.topology())) {
    std::set<std::string> addresses;
    std::uint64_t participants = 0;
    for (const capture::Participant& other : contacts.topology().participants) {
      if (other.machine != one.identity) continue;
      ++participants;
      for (const capture::Address& address : other.addresses) addresses.insert(to_string(address));
    }
    constexpr double with_silence = 0.95;
    found.push_back(
        {"same_machine_id",
         fmt::format("{} on {} ({}) announce themselves as on one machine ({}, PID_MACHINE_ID of "
                     "DATA(p)): Fast DDS from 3.2 on takes their hosts for one, and with a list of "
                     "interfaces sends the others nothing but announcements",
                     report::plural(participants, "participant"),
                     report::plural(one.hosts.size(), "host"), fmt::join(addresses, ", "),
                     one.identity),
         with_silence,
         "an /etc/machine-id of its own on each host or in each container (it is copied with "
         "images)"});
  }
}

}  // namespace stormproof::doctor
