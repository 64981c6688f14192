// Somebody came back under its old GUID, as a Discovery Server does that was killed and is started
// again before its clients' leases end. Its numbers begin at 1 again, so who remembers the old ones
// takes what it says for old news, for as long as the lease is renewed.
#include "checker/evidence/doctor/reasons/old_identity.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "checker/evidence/doctor/reasons/reasons.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::doctor {

namespace {

using capture::EntityId;
using capture::Event;

/// Numbers only grow in a life, but for packets that overtake each other.
bool is_of_a_new_life(const WriterLife& writer, const capture::HeartbeatEvent& heartbeat) {
  return heartbeat.last < writer.last && 2 * heartbeat.count < writer.count;
}

}  // namespace

WriterLives writer_lives(const Contacts& contacts) {
  WriterLives writers;
  for (std::size_t k = 0; k < contacts.counting().classes.size(); ++k) {
    const Event& event = contacts.conversation().events[k];
    const auto from = contacts.number_of(event.source);
    if (!from) continue;
    if (const auto* heartbeat = event.heartbeat()) {
      WriterLife& writer = writers[{*from, event.writer}];
      if (is_of_a_new_life(writer, *heartbeat)) {
        writer = {heartbeat->last, heartbeat->count, event.time_ns, writer.last, {}};
      }
      writer.last = std::max(writer.last, heartbeat->last);
      writer.count = std::max(writer.count, heartbeat->count);
    } else if (const auto* acknack = event.acknack(); acknack != nullptr && event.destination) {
      const auto to = contacts.number_of(*event.destination);
      const auto writer = to ? writers.find({*to, event.writer}) : writers.end();
      if (writer == writers.end() || !writer->second.is_back()) continue;
      if (acknack->missing.base > writer->second.last + 1) writer->second.deaf.insert(*from);
    }
  }
  return writers;
}

void old_identity(const Contacts& contacts, std::vector<Reason>& found) {
  std::map<std::size_t, WriterLife> back;  // by participant, what its writers have in common
  for (const auto& [who, writer] : writer_lives(contacts)) {
    if (writer.deaf.empty()) continue;
    WriterLife& all = back.try_emplace(who.first, writer).first->second;
    all.deaf.insert(writer.deaf.begin(), writer.deaf.end());
  }
  for (const auto& [who, writer] : back) {
    found.push_back(
        {"old_identity",
         fmt::format("{} came back under its old identity {} after the capture began and numbers "
                     "from 1 on again; to {}, which had got as far as {} before, what it says is "
                     "old news",
                     contacts.text(who), contacts.time_text(writer.back_ns),
                     report::plural(writer.deaf.size(), "participant"), writer.before),
         0.9,
         "stop it properly, or leave it off for longer than its lease before it starts again; "
         "restarting those who remember it helps now",
         contacts.counting().missing_count > 0});
  }
}

}  // namespace stormproof::doctor
