// Launch plans: when to start which process of a deployment. Every verb that compares them, or has
// them vary, takes them from here.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/deployment.hpp"
#include "model/scenario.hpp"

namespace stormproof::launch {

enum class Order : std::uint8_t {
  deployed,    ///< as the scenario says
  at_once,     ///< all at one instant
  by_process,  ///< each process a step after the one before
  by_host,     ///< each host a step after the one before, its processes together
  waves,       ///< each host when those before it know each other
  late_tool    ///< the last process when all others know each other
};
/// "deployed", "at_once", …, for data.
[[nodiscard]] const char* name_of(Order order);

struct Plan {
  Order order{};
  model::Nanoseconds step{};  ///< of by_process and by_host

  /// Whether a start waits for what was started before.
  [[nodiscard]] bool waits() const { return order == Order::waves || order == Order::late_tool; }
  bool operator==(const Plan&) const = default;
};
/// "process by process, 100ms apart".
[[nodiscard]] std::string words_of(const Plan& plan);

/// What a plan is called where it varies beside knobs; it is no key of a file.
inline constexpr std::string_view plan_key = "deployment.launch";
/// Whether it can vary: where somebody leaves or comes back, starts are not all that there is.
[[nodiscard]] bool can_vary(const model::Deployment& deployment);

/// Which start each participant belongs to, from 0 on in the order of the starts.
[[nodiscard]] std::vector<std::uint32_t> starts_of(const model::Deployment& deployment,
                                                   Order order);

/// The plan that the start times of a deployment follow, or `deployed` if none of those here;
/// start times that are drawn from a schedule are those of processes that are started at once.
[[nodiscard]] Plan plan_of(const model::Deployment& deployment);

/// Moves all starts of `drawn`, a scenario under a seed (trials::under_seed), to where the plan has
/// them: what the seed adds to a start stays. `base`: the deployment before that. Of a plan that
/// waits all start at once: when a start is complete, only a run tells.
void follow(const Plan& plan, const model::Deployment& base, model::Scenario& drawn);

/// The plan with `factor` times its step; nothing if it has none.
[[nodiscard]] std::optional<Plan> stepped(const Plan& plan, double factor);

/// The plans to compare: the deployed one first, spreads whose last start is within `limit`.
[[nodiscard]] std::vector<Plan> plans_for(const model::Deployment& deployment,
                                          const std::vector<model::Nanoseconds>& steps,
                                          model::Nanoseconds limit);

/// Steps from 10 ms to 2 s.
[[nodiscard]] std::vector<model::Nanoseconds> usual_steps();

}  // namespace stormproof::launch
