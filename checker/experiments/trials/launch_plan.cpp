// Who starts with whom, and by how much later.
#include "checker/experiments/trials/launch_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/core.h>

#include "checker/experiments/trials/under_seed.hpp"
#include "model/config/tree/quantities.hpp"

namespace stormproof::launch {

using model::Deployment;
using model::Nanoseconds;

const char* name_of(Order order) {
  constexpr std::array names{"deployed", "at_once", "by_process", "by_host", "waves", "late_tool"};
  return names[static_cast<std::size_t>(order)];
}

std::string words_of(const Plan& plan) {
  switch (plan.order) {
    case Order::deployed:
      return "as the scenario says";
    case Order::at_once:
      return "all at once";
    case Order::by_process:
      return fmt::format("process by process, {} apart", model::config::print_duration(plan.step));
    case Order::by_host:
      return fmt::format("host by host, {} apart", model::config::print_duration(plan.step));
    case Order::waves:
      return "host by host, when complete";
    case Order::late_tool:
      return "last process when complete";
  }
  return {};
}

bool can_vary(const Deployment& deployment) { return deployment.size() > 1 && !deployment.life; }

std::vector<std::uint32_t> starts_of(const Deployment& deployment, Order order) {
  std::map<model::HostId, std::uint32_t> hosts;  // in the order of their first participants
  std::vector<std::uint32_t> starts;
  for (std::uint32_t i = 0; i < deployment.size(); ++i) {
    const auto next = static_cast<std::uint32_t>(hosts.size());
    const std::uint32_t host = hosts.emplace(deployment.participants[i].host, next).first->second;
    const bool is_last = i + 1 == deployment.size();
    const bool one_by_one = order == Order::by_process;
    const bool host_by_host = order == Order::by_host || order == Order::waves;
    starts.push_back(one_by_one                             ? i
                     : host_by_host                         ? host
                     : order == Order::late_tool && is_last ? 1
                                                            : 0);
  }
  return starts;
}

Plan plan_of(const Deployment& deployment) {
  const auto& all = deployment.participants;
  const auto follows = [&](const Plan& plan) {
    const std::vector<std::uint32_t> starts = starts_of(deployment, plan.order);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].start != all.front().start + plan.step * starts[i]) return false;
    }
    return true;
  };
  const Plan together{Order::at_once};
  if (deployment.schedule || all.empty() || follows(together)) return together;
  for (const Order order : {Order::by_process, Order::by_host}) {
    const std::vector<std::uint32_t> starts = starts_of(deployment, order);
    const auto second = std::ranges::find(starts, 1U) - starts.begin();
    const Nanoseconds step = all[static_cast<std::size_t>(second)].start - all.front().start;
    if (step.count() > 0 && follows({order, step})) return {order, step};
  }
  return {Order::deployed};
}

void follow(const Plan& plan, const Deployment& base, model::Scenario& drawn) {
  const bool is_drawn = drawn.deployment.schedule.has_value();
  drawn.deployment.schedule.reset();
  if (plan.order == Order::deployed) return;
  const std::vector<std::uint32_t> starts = starts_of(drawn.deployment, plan.order);
  auto& participants = drawn.deployment.participants;
  for (std::size_t i = 0; i < participants.size(); ++i) {
    const Nanoseconds own = is_drawn ? Nanoseconds{} : base.participants[i].start;
    trials::start_later(participants[i], plan.step * starts[i] - own);
  }
}

std::optional<Plan> stepped(const Plan& plan, double factor) {
  const Nanoseconds step{std::llround(factor * static_cast<double>(plan.step.count()))};
  return step == plan.step ? std::nullopt : std::optional{Plan{plan.order, step}};
}

std::vector<Plan> plans_for(const Deployment& deployment, const std::vector<Nanoseconds>& steps,
                            Nanoseconds limit) {
  std::vector<Plan> plans{plan_of(deployment)};
  const auto add = [&](const Plan& plan) {
    if (plan != plans.front()) plans.push_back(plan);
  };
  add({Order::at_once});
  const bool one_each = deployment.host_count() == deployment.size();
  for (const Order order : {Order::by_process, Order::by_host}) {
    if (order == Order::by_host && one_each) continue;
    const auto last = static_cast<std::int64_t>(starts_of(deployment, order).back());
    for (const Nanoseconds step : steps) {
      if (step * last < limit) add({order, step});
    }
  }
  add({Order::waves});
  add({Order::late_tool});
  return plans;
}

std::vector<Nanoseconds> usual_steps() {
  std::vector<Nanoseconds> steps;
  for (const std::int64_t ms : {10, 20, 50, 100, 200, 400, 1'000, 2'000}) {
    steps.emplace_back(ms * 1'000'000);
  }
  return steps;
}

}  // namespace stormproof::launch
