// The open-loop traffic of a deployment: all that it can send as long as nothing is lost and
// nothing is repaired, whatever its start times are. Announcements and periodic HEARTBEATs recur;
// everything else is sent once for each descriptor, relation or recognition. Each line is an upper
// bound, derived from the rules of fsm/composition; tests hold it against runs.
// specs/guide/cannot-start.md derives each line.
#pragma once

#include <vector>

#include "checker/engines/calculus/recurrence.hpp"
#include "model/run_result.hpp"
#include "model/scenario.hpp"

namespace stormproof::calculus {

/// No longer delays are looked for, ns.
inline constexpr std::int64_t hour = 3'600'000'000'000;

/// Packets of one kind with one cause.
struct Flow {
  const char* what = "";  ///< "periodic HEARTBEATs"
  model::TrafficClass traffic{};
  std::int64_t messages = 0;  ///< each time, over the whole deployment
  std::int64_t airtime = 0;   ///< of these, over all stages of the route, ns
  Recurrence when;
};

/// What is left out, to show that it must not be.
struct Omission {
  bool heartbeats = false;    ///< of the writers, and their answers
  bool piggyback = false;     ///< those that DATA causes
  bool same_host = false;     ///< participants of the same host
  bool user_control = false;  ///< control-only relations
  bool port_copies = false;   ///< what static peers send instead of a multicast
  bool repairs = false;       ///< what is asked for without need (closed_loop.hpp)
  bool caused = false;        ///< the HEARTBEATs that repairs add to
};

struct OpenLoop {
  std::vector<Flow> flows;
  std::int64_t exhaustions = 0;     ///< how often DATA uses up a piggyback budget, at most
  std::int64_t push_fragments = 0;  ///< of the largest packet with pushed DATA

  /// The work that arrives in a closed window of length `window`, in ns of airtime, if no packet
  /// takes longer than `delay`; `endless` if it is too much to say.
  [[nodiscard]] std::int64_t work(std::int64_t window, std::int64_t delay) const;
};

/// Why the traffic of such scenarios is not bounded here; null: it is.
[[nodiscard]] const char* uncovered(const model::Scenario& scenario);

/// Of a scenario that is covered, on a shared channel.
[[nodiscard]] OpenLoop open_loop(const model::Scenario& scenario, const Omission& omission = {});

/// The longest time for which the channels can be busy without a pause, and so the longest that any
/// packet can take: the least L with work(L, max(L, loopback)) ≤ L. Nothing: there is none below an
/// hour.
struct BusyPeriod {
  model::Nanoseconds length;
  std::uint32_t steps = 0;  ///< of the iteration
};
[[nodiscard]] std::optional<BusyPeriod> busy_period(const OpenLoop& traffic,
                                                    model::Nanoseconds loopback);

}  // namespace stormproof::calculus
