// Something is missing, and somebody was there before the capture began: what was sent then is not
// in it, so nobody can tell whether it was sent.
#include "checker/evidence/doctor/reasons/began_late.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "checker/evidence/doctor/reasons/reasons.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::doctor {

using capture::Conversation;
using capture::Event;
using capture::GuidPrefix;

std::uint64_t known_before(const Conversation& conversation, const capture::Counting& counting) {
  std::map<std::tuple<GuidPrefix, GuidPrefix, capture::EntityId>, std::int64_t> base;
  for (const Event& event : conversation.events) {
    const auto* acknack = event.acknack();
    if (acknack == nullptr || !event.destination) continue;
    std::int64_t& known = base[{*event.destination, event.source, event.writer}];
    known = std::max(known, acknack->missing.base);
  }
  return static_cast<std::uint64_t>(
      std::ranges::count_if(counting.missing, [&](const capture::MissingKey& key) {
        const auto found = base.find({key.source, key.destination, key.writer});
        return found != base.end() && key.sequence_number < found->second;
      }));
}

std::size_t there_before(const Conversation& conversation) {
  std::set<GuidPrefix> seen;
  std::size_t before = 0;
  for (const Event& event : conversation.events) {
    if (!seen.insert(event.source).second) continue;
    if (event.traffic() != capture::Traffic::spdp) ++before;
  }
  return before;
}

void began_late(const Contacts& contacts, std::vector<Reason>& found) {
  const std::size_t before = there_before(contacts.conversation());
  if (before == 0 || contacts.counting().missing_count == 0) return;
  found.push_back({"began_late",
                   fmt::format("the capture began when {} had begun, so it does not show what was "
                               "sent before",
                               report::plural(before, "participant")),
                   1, "start the capture first, then the programs", false});
}

}  // namespace stormproof::doctor
