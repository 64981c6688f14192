// The closed loop without a loss: open-loop traffic, what is repaired without need while packets
// are under way, and what that causes. A descriptor can be asked for without need only until it
// arrives; so if no packet takes longer than D, repairs are counted, and so is their load. The
// least D* that suffices for its own load bounds every delay, storms included: completion follows
// from the deployment alone. specs/guide/cannot-start.md, "The closed loop".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "checker/engines/bounds/check_request.hpp"
#include "checker/engines/calculus/open_loop.hpp"

namespace stormproof::timeline {
class Theorem;  // checker/engines/timeline/theorem.hpp
}

namespace stormproof::calculus {

/// What is repaired without need in a whole run, at most.
struct Repairs {
  std::int64_t copies = 0;  ///< of one descriptor at one reader
  std::int64_t sent = 0;    ///< of all descriptors at all readers on other hosts
};

struct ClosedLoop {
  std::optional<model::Nanoseconds> delay;  ///< D*: no packet takes longer; absent: no bound
  std::string gap;                          ///< why there is none
  std::optional<model::Nanoseconds> busy;   ///< the channel is busy no longer than this
  /// Of lateness: the airtime that a longer delay adds, for each nanosecond. Below 1 there is a D*,
  /// unless it is beyond an hour. Absent: at links, and where one repair causes the next without
  /// end.
  std::optional<double> gain;
  OpenLoop traffic;        ///< all of it, at D*
  Repairs repairs;         ///< at D*
  std::int64_t first = 0;  ///< descriptors times readers on other hosts
  /// From the last start, or creation of an endpoint, until everybody has everything.
  model::Nanoseconds completion;
  /// From there until the last DATA, HEARTBEAT or ACKNACK of SEDP is sent. Absent: no certificate
  /// says so of its rules.
  std::optional<model::Nanoseconds> silence;

  /// All messages up to `until` from the first start, at most.
  [[nodiscard]] std::int64_t messages(model::Nanoseconds until) const;
};

[[nodiscard]] ClosedLoop closed_loop(const model::Scenario& scenario,
                                     const Omission& omission = {});

/// The steps of the proof, for all timers and delays, and the numbers of this deployment.
void prove_closed_loop(timeline::Theorem& theorem, const ClosedLoop& loop);

/// live.completion of the deployment alone, and what else is true of it; nothing if there is no
/// bound.
[[nodiscard]] std::optional<props::Finding> completion_of_deployment(
    const ClosedLoop& loop, const checker::CheckRequest& request);
/// live.quiescence of it.
[[nodiscard]] std::optional<props::Finding> quiescence_of_deployment(
    const ClosedLoop& loop, const checker::CheckRequest& request);
/// The same in lines, or why there is none.
[[nodiscard]] std::vector<std::string> closed_loop_lines(const ClosedLoop& loop,
                                                         const model::Scenario& scenario);

}  // namespace stormproof::calculus
