// storm.cannot-start: from the load to the delay, and from the delay back to the load. Until the
// first needless repair only open-loop traffic is on the channel; if no packet of it can take
// longer than the threshold, there is no first needless repair.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "checker/engines/calculus/threshold.hpp"

namespace stormproof::timeline {
class Theorem;  // checker/engines/timeline/theorem.hpp
}

namespace stormproof::calculus {

inline constexpr std::string_view cannot_start = "storm.cannot-start";

/// What follows from a deployment alone.
struct Judged {
  Threshold threshold;
  std::optional<OpenLoop> traffic;          ///< absent: there is no channel, or it is not covered
  std::optional<model::Nanoseconds> busy;   ///< the longest busy period of the channel
  std::optional<model::Nanoseconds> delay;  ///< no packet takes longer; absent: no bound
  std::string gap;                          ///< why there is no bound

  [[nodiscard]] bool is_proved() const {
    return threshold.exists() && (threshold.unlimited || (delay && *delay <= threshold.delta));
  }
};
[[nodiscard]] Judged judge(const model::Scenario& scenario, const Omission& omission = {});

/// "no packet is lost", and if the scenario loses some, that nothing is said of its own run.
[[nodiscard]] std::string without_losses(const model::Scenario& scenario);

/// The lemmas that the deployment's threshold needs, for all timers, delays and loads.
void prove_lemmas(timeline::Theorem& theorem, Lemma lemma);
/// The numbers of this deployment: the work of a busy period of this length does not exceed it.
void prove_numbers(timeline::Theorem& theorem, const OpenLoop& traffic, model::Nanoseconds busy,
                   model::Nanoseconds delay);

}  // namespace stormproof::calculus
