// A participant that says that it leaves, or that falls silent while others go on, is no longer
// seen.
#include <algorithm>

#include <fmt/format.h>

#include "checker/evidence/doctor/reasons/reasons.hpp"
#include "checker/presentation/text/numbers.hpp"

namespace stormproof::doctor {

namespace {

/// Longer than the lease of any shipped profile, or what the participant says itself.
constexpr std::int64_t usual_lease_ns = 20'000'000'000;

}  // namespace

void went_away(const Contacts& contacts, std::vector<Reason>& found) {
  const auto& list = contacts.topology().participants;
  const capture::Conversation& conversation = contacts.conversation();
  const std::int64_t end_ns = std::min(conversation.last_ns, contacts.counting().until_ns);
  constexpr std::size_t most_told = 8;
  for (std::size_t k = 0; k < list.size() && found.size() < most_told; ++k) {
    const Contact& one = contacts.of(k);
    const auto at = [&](std::int64_t time_ns) {
      return report::duration(model::Nanoseconds{time_ns - conversation.first_ns});
    };
    if (one.gone_ns != INT64_MIN && one.gone_ns >= one.last_ns) {
      found.push_back({"left",
                       fmt::format("{} said that it leaves, {} after the capture began",
                                   contacts.text(k), at(one.gone_ns)),
                       1, "start it again, if it was to stay", false});
      continue;
    }
    const std::int64_t lease_ns = list[k].lease_ns.value_or(usual_lease_ns);
    const bool is_silent =
        one.last_ns != INT64_MIN && !one.announced.empty() && end_ns - one.last_ns > lease_ns;
    if (!is_silent) continue;
    found.push_back(
        {"fell_silent",
         fmt::format("{} sent nothing more from {} after the capture began on, for longer "
                     "than its lease of {}: the others have forgotten it",
                     contacts.text(k), at(one.last_ns),
                     report::duration(model::Nanoseconds{lease_ns})),
         0.9, "look whether the process still runs, and at its network", false});
  }
}

}  // namespace stormproof::doctor
