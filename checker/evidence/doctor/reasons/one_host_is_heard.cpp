// Only one host's packets are in the capture. It may be alone; or the others' announcements do not
// arrive, because multicast is filtered; or the capture has one direction only. What the one host
// sends tells some of them apart.
#include <algorithm>

#include <fmt/format.h>

#include "checker/evidence/doctor/reasons/listeners.hpp"
#include "checker/evidence/doctor/reasons/reasons.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::doctor {

namespace {

const char* const how_to_tell =
    "capture on each host at the same time and give doctor all captures; try `ros2 multicast "
    "receive` there and `ros2 multicast send` here; on a switch look for IGMP snooping without a "
    "querier, at an access point for client isolation, on the hosts at the firewall (UDP 7400 and "
    "above)";

/// Whether a capture of this host has announcements of another host.
bool hears_others(const Contacts& contacts) { return contacts.hosts().size() > 1; }

/// Of several captures: each holds announcements of one host only, though others announce.
void told_apart_by_captures(const Contacts& contacts, std::vector<Reason>& found) {
  const capture::Conversation& conversation = contacts.conversation();
  if (conversation.captures.size() < 2 || contacts.hosts().size() < 2) return;
  std::map<capture::Address, std::size_t> host;
  for (const capture::Participant& one : contacts.topology().participants) {
    for (const capture::Address& address : one.addresses) host[address] = one.host;
  }
  bool multicast_crosses = false;
  bool unicast_crosses = false;
  bool each_has_one = true;
  for (const capture::CaptureInfo& one : conversation.captures) {
    std::map<std::size_t, std::uint64_t> announced;
    for (const auto& [address, datagrams] : one.multicast_sources) {
      if (const auto from = host.find(address); from != host.end()) {
        announced[from->second] += datagrams;
      }
    }
    multicast_crosses = multicast_crosses || announced.size() > 1;
    each_has_one = each_has_one && announced.size() == 1;
    std::set<std::size_t> all;
    for (const auto& [address, datagrams] : one.sources) {
      if (const auto from = host.find(address); from != host.end()) all.insert(from->second);
    }
    unicast_crosses = unicast_crosses || all.size() > 1;
  }
  if (multicast_crosses || !each_has_one) return;
  // Captures of what each host sends, merged, look the same: then the answers are there.
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (contacts.of(k).answers > 0) return;
  }
  found.push_back(
      {"multicast_filtered",
       fmt::format("each of the {} captures has announcements of its own host only, and nobody "
                   "answers another host: {}{}",
                   conversation.captures.size(),
                   unicast_crosses ? "unicast arrives and multicast does not, so multicast is "
                                     "filtered (IGMP snooping without a querier, or the access "
                                     "point)"
                                   : "nothing arrives of what the others send (client isolation, a "
                                     "firewall, or not the same network)",
                   listeners(contacts).text),
       unicast_crosses ? 0.9 : 0.7, how_to_tell});
}

}  // namespace

void one_host_is_heard(const Contacts& contacts, std::vector<Reason>& found) {
  if (hears_others(contacts)) return told_apart_by_captures(contacts, found);
  if (contacts.size() == 0) return;
  std::uint64_t announcements = 0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    announcements += contacts.of(k).announced.size() + contacts.of(k).directed;
  }
  if (announcements == 0) return;
  const std::string who = fmt::format("only {} is heard, with {}", contacts.host_text(0),
                                      report::plural(contacts.size(), "participant"));
  std::uint64_t answers = 0;
  for (const auto& [end, messages] : contacts.unseen()) answers += messages;
  if (answers > 0) {
    found.push_back(
        {"one_direction",
         fmt::format("{}: it sends {} to {} elsewhere whose own packets are not in the capture. So "
                     "it knows them, and either what they send is not captured, or it knows them "
                     "from before and they do not answer any more",
                     who, report::plural(answers, "message"),
                     report::plural(contacts.unseen().size(), "participant")),
         0.7,
         "capture both directions, or on the other host, too; without captured answers nothing "
         "more "
         "can be told"});
    return;
  }
  // Participants of one host that discover each other are a system of one host, which is complete.
  if (contacts.counting().required > 0 && contacts.counting().missing_count == 0) return;
  const Listeners igmp = listeners(contacts);
  found.push_back(
      {"one_host",
       fmt::format("{}: no other host's announcements arrive where it was captured, and "
                   "it answers nobody. Multicast is filtered between them (IGMP snooping "
                   "without a querier, client isolation, a firewall){}{}",
                   who, igmp.others_listen ? "" : ", or nothing else runs", igmp.text),
       igmp.others_listen ? 0.9 : 0.6, how_to_tell});
}

}  // namespace stormproof::doctor
