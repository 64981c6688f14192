// A participant that says that it leaves, or that falls silent while others go on, is no longer
// seen. Until its lease is over it is a ghost: the others still count on it.
#include <algorithm>

#include <fmt/format.h>

#include "checker/evidence/doctor/reasons/reasons.hpp"
#include "checker/presentation/text/numbers.hpp"

namespace stormproof::doctor {

void went_away(const Contacts& contacts, std::vector<Reason>& found) {
  const auto& list = contacts.topology().participants;
  const capture::Conversation& conversation = contacts.conversation();
  const std::int64_t end_ns = std::min(conversation.last_ns, contacts.counting().until_ns);
  constexpr std::size_t most_told = 8;
  for (std::size_t k = 0; k < list.size() && found.size() < most_told; ++k) {
    const Contact& one = contacts.of(k);
    if (one.gone_ns != INT64_MIN && one.gone_ns >= one.last_ns) {
      found.push_back({"left",
                       fmt::format("{} said that it leaves, {} after the capture began",
                                   contacts.text(k), contacts.time_text(one.gone_ns)),
                       1, "start it again, if it was to stay", false});
      continue;
    }
    const std::int64_t lease_ns = lease_of(contacts, k);
    if (one.last_ns == INT64_MIN || one.announced.empty()) continue;
    const std::int64_t silence_ns = end_ns - one.last_ns;
    if (silence_ns <= longest_pause_ns(contacts, k)) continue;
    const std::string since = fmt::format("{} sent nothing more from {} after the capture began on",
                                          contacts.text(k), contacts.time_text(one.last_ns));
    const std::string lease = report::duration(model::Nanoseconds{lease_ns});
    if (silence_ns > lease_ns) {
      found.push_back({"fell_silent",
                       fmt::format("{}, for longer than its lease of {}: the others have forgotten "
                                   "it",
                                   since, lease),
                       0.9, "look whether the process still runs, and at its network", false});
    } else {
      found.push_back({"ghost",
                       fmt::format("{}, and did not say that it leaves: the others keep it, as a "
                                   "ghost, until its lease of {} is over",
                                   since, lease),
                       0.7, "look whether the process still runs, and at its network", false});
    }
  }
}

}  // namespace stormproof::doctor
