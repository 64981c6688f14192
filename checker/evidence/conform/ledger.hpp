// What the sides of all relations write down while they explain events: rules used, hidden events,
// rows fired, and how much of the bounds it took. Also the way a Boost.MSM machine is stepped so
// that the row that fired is counted.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "checker/evidence/conform/conform.hpp"
#include "checker/evidence/conform/dialogue.hpp"
#include "fsm/stepper.hpp"

namespace stormproof::conform {

/// Steps machines of one kind and counts the rows that fire.
template <class Machine>
class Tally {
 public:
  using Fly = fsm::Stepper<Machine>;

  template <class Event>
  typename Fly::Output step(fsm::StateId& state, const typename Fly::Input& input) {
    fsm::RowId row = fsm::no_row;
    const auto output = machine_.template step<Event>(state, input, row);
    if (row != fsm::no_row) ++uses_[row];
    return output;
  }

  void report(std::vector<RowUse>& into) const {
    const fsm::MachineInfo info = fsm::Reflect<Machine>::info();
    for (std::size_t k = 0; k < info.rows.size(); ++k) {
      const fsm::RowInfo& row = info.rows[k];
      std::string text{info.states[row.source]};
      text += " + ";
      text += info.events[row.event];
      if (row.guard != "none") text += " [" + row.guard + "]";
      if (row.action != "none") (text += " / ") += row.action;
      (text += " → ") += info.states[row.target];
      into.push_back({info.name, k, std::move(text), uses_[k]});
    }
  }

 private:
  Fly machine_;
  std::array<std::uint64_t, fsm::Reflect<Machine>::Rows::size> uses_{};
};

/// Written by one place after the other.
struct Ledger {
  Conformance& result;
  PlaceResult& place;

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
