// The two conditions, and the words for them.
#include "checker/engines/exact/storm.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "checker/presentation/text/numbers.hpp"

namespace stormproof::exact {

double needless_limit(const std::optional<model::Limits>& limits) {
  return limits && limits->needless ? limits->needless->value() : 1;
}

model::Nanoseconds late_limit(const std::optional<model::Limits>& limits) {
  constexpr model::Nanoseconds usual{1'000'000'000};
  return limits ? limits->late.value_or(usual) : usual;
}

double part_of(double needed, double sent) { return sent > 0 ? std::min(1.0, needed / sent) : 1; }

Sent sent_of(const PerClass& amount, const PerClass& messages, const model::Counts& failure_free,
             double needed_repairs) {
  using model::TrafficClass;
  const auto of = [&](TrafficClass one) { return amount[static_cast<std::size_t>(one)]; };
  const auto part = [&](TrafficClass one, std::uint64_t needed) {
    return Traffic{of(one),
                   part_of(static_cast<double>(needed), messages[static_cast<std::size_t>(one)])};
  };
  Sent sent;
  sent.initial_data = of(TrafficClass::initial_data);
  sent.repair_data = of(TrafficClass::repair_data);
  sent.needed_repairs = needed_repairs;
  sent.heartbeats = part(TrafficClass::heartbeat, failure_free.heartbeat);
  sent.acknacks = part(TrafficClass::acknack, failure_free.acknack);
  sent.announcements = part(TrafficClass::spdp, failure_free.spdp() + failure_free.of_server());
  sent.lookups = of(TrafficClass::lookup);
  sent.user_control = of(TrafficClass::user_control);
  return sent;
}

Expense expense_of(const Sent& sent, bool is_late) {
  const auto once = [](const Traffic& traffic) { return traffic.sent * traffic.once; };
  const auto beyond = [](const Traffic& traffic) { return traffic.sent * (1 - traffic.once); };
  const double repeats = sent.repair_data * (1 - sent.needed_repairs);
  const double data = sent.initial_data + sent.repair_data;
  const double share = data > 0 ? repeats / data : 0;
  Expense took;
  took.is_late = is_late;
  took.once = sent.initial_data + once(sent.heartbeats) + once(sent.acknacks) +
              once(sent.announcements) + sent.user_control;
  took.needless =
      repeats + sent.lookups + share * (beyond(sent.heartbeats) + beyond(sent.acknacks));
  return took;
}

bool is_storm(const Expense& took, const std::optional<model::Limits>& limits) {
  return took.is_late && took.needless > needless_limit(limits) * took.once;
}

std::string storm_definition(const std::optional<model::Limits>& limits) {
  return fmt::format(
      "A storm: needless repeats and lookups of types, with the control traffic that they cause, "
      "take more than {} the airtime of everything sent once (limits.needless), and discovery is "
      "not complete, or takes "
      "longer than {} from the last start on (limits.late).",
      report::ratio(needless_limit(limits), 1), report::duration(late_limit(limits)));
}

}  // namespace stormproof::exact
