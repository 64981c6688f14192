// What the sides of all relations write down while they explain events: rules used, hidden events,
// rows of machines that fired, and how much of the bounds it took.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "checker/evidence/conform/conform.hpp"
#include "checker/evidence/conform/dialogue.hpp"

namespace stormproof::conform {

struct Machines;

/// Written by one place after the other.
struct Ledger {
  Conformance& result;
  PlaceResult& place;
  Machines& machines;

  /// By a rule of which what sends is clear.
  void explained(Rule rule, std::uint64_t times = 1) {
    const auto senders = senders_of(rule);
    explained(rule, senders.empty() ? Sender{} : senders.front(), times);
  }
  /// By a rule that several can send by. No scope: it is not shown.
  void explained(Rule rule, const Sender& sender, std::uint64_t times = 1) {
    if (!sender.scope.empty()) result.by_sender[sender] += times;
    result.by_rule[static_cast<std::size_t>(rule)] += times;
    result.explained += times;
    place.explained += times;
  }
  void not_replayed() { ++result.not_replayed; }
  void undecided() { ++result.undecided; }
  void hidden(Hidden::Kind kind, std::int64_t time_ns, std::optional<std::size_t> event,
              std::string_view machine = {}) {
    result.hidden.push_back({kind, time_ns, event, place.place, machine});
    if (kind == Hidden::Kind::lost) {
      ++result.lost;
      ++place.lost;
    }
  }
  void used_lag(std::int64_t ns) {
    result.used_send_lag_ns = std::max(result.used_send_lag_ns, ns);
  }
  void used_clock_age(std::int64_t ns) {
    result.used_clock_age_ns = std::max(result.used_clock_age_ns, ns);
  }
  void used_lateness(std::int64_t ns) {
    result.used_lateness_ns = std::max(result.used_lateness_ns, ns);
  }
};

}  // namespace stormproof::conform
