// The durations of a random scenario: nine orders of magnitude, around the scale of the scenario,
// with ties on purpose.
#include <optional>

#include "model/airtime.hpp"
#include "model/reference.hpp"
#include "props/generators/draw.hpp"

namespace stormproof::props {

namespace {

using model::Nanoseconds;

// So fast that the airtime of a fragment is its overhead alone, whatever its size.
constexpr model::BitsPerSecond lockstep_rate{100'000'000'000'000};

void fall_into_lockstep(Dice& dice, model::WirelessProfile& w, std::int64_t step) {
  w.overhead_unicast = Nanoseconds{step};
  w.overhead_multicast = Nanoseconds{step * dice.between(1, 2)};
  w.rate_unicast = lockstep_rate;
  w.rate_multicast = lockstep_rate;
  w.one_way = Nanoseconds{step * dice.between(0, 3)};
  for (model::Stage& stage : w.stages) {
    if (stage.overhead_unicast) stage.overhead_unicast = Nanoseconds{step * dice.between(1, 2)};
    if (stage.overhead_multicast) stage.overhead_multicast = Nanoseconds{step};
    if (stage.rate_unicast) stage.rate_unicast = lockstep_rate;
    if (stage.rate_multicast) stage.rate_multicast = lockstep_rate;
  }
}

// Two durations with their double, sum and difference: τ_A + τ_N meets τ_H, and the like.
std::vector<std::int64_t> draw_pool(Dice& dice, std::int64_t scale) {
  const std::int64_t a = dice.between(scale / 16 + 1, scale / 2 + 1);
  const std::int64_t b = dice.chance(50) ? dice.magnitude(1, scale) : a + dice.between(-1, 1);
  const std::int64_t difference = a < b ? b - a : a - b;
  return {a, a, b, std::max<std::int64_t>(b, 1), a + b, 2 * a, difference, 0};
}

/// Airtime of a few packets for each pair of participants.
std::int64_t packets_for_all(const model::Scenario& scenario) {
  constexpr std::int64_t packets = 16;
  constexpr std::int64_t bytes = 400;
  const auto n = static_cast<std::int64_t>(scenario.deployment.size());
  std::int64_t airtime = 0;
  for (const model::Stage& stage : scenario.wireless.stages) {
    airtime += model::service_rate(scenario.wireless, stage, false).airtime_ns(bytes);
  }
  return n * (n - 1) * packets * airtime;
}

}  // namespace

Clock draw_clock(Dice& dice, const ScenarioSpace& space, model::Scenario& scenario) {
  Clock clock;
  clock.lockstep = dice.chance(30);
  if (clock.lockstep) {
    clock.grid = dice.among({1, 1, 7, microsecond, 10 * microsecond, 100 * microsecond,
                             100 * microsecond, millisecond, 50 * millisecond});
    fall_into_lockstep(dice, scenario.wireless, clock.grid);
  }
  const bool is_delay = scenario.wireless.kind == model::ServiceKind::constant_delay;
  const std::optional<Nanoseconds> airtime =
      is_delay ? std::nullopt : model::open_loop_airtime(scenario);
  const bool has_no_baseline = !is_delay && !airtime;
  const std::int64_t work = has_no_baseline ? packets_for_all(scenario)
                            : airtime       ? airtime->count()
                                            : 6 * scenario.wireless.one_way.count();
  const std::int64_t longest = std::min(4 * second, space.max_time_limit.count() / 2);
  const std::int64_t shortest = clock.lockstep ? 8 * clock.grid : 200 * microsecond;
  clock.scale = std::min(std::max(work, shortest), longest);
  if (!clock.lockstep) {
    clock.grid = dice.among(
        {1, 1, 10 * microsecond, 100 * microsecond, std::max<std::int64_t>(clock.scale / 16, 1)});
    if (dice.chance(30)) clock.pool = draw_pool(dice, clock.scale);
  }
  return clock;
}

Nanoseconds draw_reaction(Dice& dice, const Clock& clock, std::int64_t usual) {
  if (clock.lockstep) return Nanoseconds{clock.grid * dice.among({0, 0, 1, 1, 2, 5})};
  if (!clock.pool.empty() && dice.chance(70)) return Nanoseconds{dice.pick(clock.pool)};
  const std::int64_t t = dice.among({usual, usual, 0, 1, dice.magnitude(1, second),
                                     dice.magnitude(1, clock.scale), clock.scale / 16});
  return Nanoseconds{dice.chance(50) ? clock.on_grid(t) : t};
}

Nanoseconds draw_period(Dice& dice, const Clock& clock) {
  if (dice.chance(4)) return Nanoseconds{dice.magnitude(second, 1'000'000 * second)};
  const std::int64_t least = std::max<std::int64_t>(clock.scale / 10, 1);
  if (!clock.pool.empty() && dice.chance(50)) {
    return Nanoseconds{std::max(least, dice.pick(clock.pool))};
  }
  const std::int64_t t =
      dice.among({clock.scale / 8, clock.scale, dice.magnitude(least, 4 * clock.scale)});
  return Nanoseconds{std::max<std::int64_t>(1, clock.on_grid(t))};
}

}  // namespace stormproof::props
