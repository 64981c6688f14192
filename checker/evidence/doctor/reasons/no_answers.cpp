// Announcements arrive, and what should follow them by unicast does not: from nobody, from one
// host, or in one direction only.
#include <algorithm>

#include <fmt/format.h>

#include "checker/evidence/doctor/reasons/reasons.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::doctor {

namespace {

/// So many messages deserve an answer: one may be under way when the capture ends.
constexpr std::uint64_t worth_an_answer = 4;

bool share_a_domain(const Contacts& contacts, std::size_t one, std::size_t other) {
  const auto& some = contacts.of(one).domains;
  const auto& others = contacts.of(other).domains;
  if (some.empty() || others.empty()) return true;
  return std::ranges::any_of(some, [&](std::uint32_t domain) { return others.contains(domain); });
}

bool announces(const Contact& contact) {
  return !contact.announced.empty() || contact.directed > 0;
}

/// Two announcements within a second: a participant that starts, or hears of somebody new.
bool starts_here(const Contacts& contacts) {
  constexpr std::int64_t soon_ns = 1'000'000'000;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const auto& times = contacts.of(k).announced;
    for (std::size_t i = 1; i < times.size(); ++i) {
      if (times[i] - times[i - 1] < soon_ns) return true;
    }
  }
  return false;
}

/// Whether participants of two hosts announce themselves in one domain.
bool could_talk(const Contacts& contacts) {
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    for (std::size_t j = 0; j < k; ++j) {
      const auto& list = contacts.topology().participants;
      if (list[k].host == list[j].host || !share_a_domain(contacts, k, j)) continue;
      if (announces(contacts.of(k)) && announces(contacts.of(j))) return true;
    }
  }
  return false;
}

void nobody_answers(const Contacts& contacts, std::vector<Reason>& found) {
  constexpr double if_starts = 0.9;
  constexpr double otherwise = 0.5;
  const bool starts = starts_here(contacts);
  found.push_back(
      {"no_answers",
       fmt::format("{} announce themselves, and no unicast message of discovery follows between "
                   "them: a firewall or client isolation lets multicast pass and unicast not{}",
                   report::plural(contacts.hosts().size(), "host"),
                   starts ? ""
                          : "; or all of them knew each other when the capture began, since none "
                            "of them starts in it"),
       starts ? if_starts : otherwise,
       "open UDP 7400 and above on each host, switch client isolation off at the access point, try "
       "ping both ways; start one of the programs anew while you capture, which tells both apart"});
}

struct SilentHost {
  std::uint64_t told = 0;
  std::set<std::size_t> by;  ///< hosts that told it
};

/// Hosts that are told things and send no unicast to anybody.
std::map<std::size_t, SilentHost> silent_hosts(const Contacts& contacts) {
  std::map<std::size_t, SilentHost> silent;
  const auto& list = contacts.topology().participants;
  for (std::size_t h = 0; h < contacts.hosts().size(); ++h) {
    SilentHost one;
    std::uint64_t answers = 0;
    for (const std::size_t to : contacts.hosts()[h]) {
      answers += contacts.of(to).answers;
      one.told += contacts.of(to).told;
      for (std::size_t from = 0; from < contacts.size(); ++from) {
        if (contacts.messages(from, to) > 0) one.by.insert(list[from].host);
      }
    }
    if (answers == 0 && one.told >= worth_an_answer) silent[h] = std::move(one);
  }
  return silent;
}

/// Pairs of hosts of which one tells the other and gets nothing back, though that one answers
/// others.
void one_way(const Contacts& contacts, const std::map<std::size_t, SilentHost>& silent,
             std::vector<Reason>& found) {
  const auto& list = contacts.topology().participants;
  std::map<std::pair<std::size_t, std::size_t>, std::uint64_t> told;
  std::set<std::size_t> to_all;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (contacts.of(k).multicast_data > 0) to_all.insert(list[k].host);
    for (std::size_t j = 0; j < contacts.size(); ++j) {
      const std::uint64_t messages = contacts.messages(k, j);
      if (messages > 0) told[{list[k].host, list[j].host}] += messages;
    }
  }
  for (const auto& [hosts, messages] : told) {
    const auto& [from, to] = hosts;
    if (messages < worth_an_answer || told.contains({to, from})) continue;
    if (silent.contains(to) || to_all.contains(to)) continue;
    found.push_back({"one_way",
                     fmt::format("{} sends {} to {}, and nothing comes back, although that host "
                                 "answers others: between these two one direction fails",
                                 contacts.host_text(from), report::plural(messages, "message"),
                                 contacts.host_text(to)),
                     0.9,
                     "look at firewalls and routes between these two hosts, in this direction"});
  }
}

}  // namespace

void no_answers(const Contacts& contacts, std::vector<Reason>& found) {
  if (contacts.hosts().size() < 2 || !could_talk(contacts)) return;
  bool some_talk = false;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    some_talk = some_talk || contacts.of(k).answers > 0;
  }
  if (!some_talk) {
    const bool is_told_already = std::ranges::any_of(found, [](const Reason& one) {
      return one.id == "multicast_filtered" || one.id == "same_machine_id";
    });
    if (!is_told_already) nobody_answers(contacts, found);
    return;
  }
  const auto silent = silent_hosts(contacts);
  for (const auto& [host, one] : silent) {
    found.push_back(
        {"silent_host",
         fmt::format("{} is announced and is sent {}, and answers nobody: its answers do not "
                     "arrive, what it is sent does not reach it, or what it sends is not captured",
                     contacts.host_text(host), report::plural(one.told, "message")),
         0.8,
         "look at this host's firewall (UDP 7400 and above, in and out), its interface and its "
         "routes; capture on it: if its answers leave there, they are lost on the way"});
  }
  one_way(contacts, silent, found);
}

}  // namespace stormproof::doctor
