// The deployment of a random scenario: few participants on two to four hosts, unevenly, with uneven
// endpoints; starts that are equal, nearly equal or far apart.
#include "model/fastdds/endpoints.hpp"
#include "props/generators/draw.hpp"

namespace stormproof::props {

namespace {

using model::Nanoseconds;
using model::Participant;
using model::Scenario;

constexpr std::uint32_t most_hosts = 4;

// A Fast DDS message takes about 160 descriptors; a space that allows more endpoints gets some.
constexpr std::uint32_t full_message = 160;

std::uint32_t draw_endpoints(Dice& dice, std::uint32_t most) {
  const std::uint32_t few = std::min(most, 3U);
  return dice.pick<std::uint32_t>({0, dice.count(0, few), dice.count(0, std::min(most, 20U))});
}

// How long a participant takes to create its endpoints: nothing, one step for each, or any time.
std::int64_t draw_creation(Dice& dice, const Clock& clock, const Participant& p) {
  const std::int64_t count = std::int64_t{model::fastdds::default_publications} +
                             model::fastdds::default_subscriptions + p.publications +
                             p.subscriptions;
  const std::int64_t step = clock.grid * dice.between(1, 2);
  if (clock.lockstep) return count * step * dice.between(0, 1);
  return dice.among({0, std::min(count * step, clock.scale), clock.scale / 4, clock.scale,
                     dice.between(0, clock.scale), dice.magnitude(1, clock.scale)});
}

enum class Starts { together, near_ties, scattered, far_apart };

std::int64_t draw_start(Dice& dice, const Clock& clock, Starts starts, std::int64_t latest) {
  switch (starts) {
    case Starts::together:
      return 0;
    case Starts::near_ties:
      return dice.among({0, 0, 1, clock.grid, clock.grid + 1, 2 * clock.grid});
    case Starts::scattered:
      return clock.on_grid(dice.among({0, clock.scale / 4, dice.magnitude(1, clock.scale)}));
    case Starts::far_apart:
      return latest + clock.on_grid(dice.among({clock.scale / 2, clock.scale, clock.scale + 1}));
  }
  return 0;
}

void draw_loopback(Dice& dice, const Clock& clock, Scenario& scenario) {
  const std::int64_t one_way = scenario.wireless.one_way.count();
  const std::int64_t other = dice.among({0, one_way, 1, 60 * microsecond, 2 * millisecond,
                                         2 * millisecond, dice.magnitude(1, second)});
  const std::int64_t steps = clock.grid * dice.between(0, 3);
  scenario.deployment.loopback_delay = Nanoseconds{clock.lockstep ? steps : other};
}

/// How long a packet takes to be sent, and when participants hear.
void draw_thread(Dice& dice, const Clock& clock, Scenario& scenario) {
  const std::int64_t steps = clock.grid * dice.between(0, 2);
  const std::int64_t other = dice.among({0, 20 * microsecond, 50 * microsecond, clock.scale / 500,
                                         dice.magnitude(1, clock.scale / 40 + 1)});
  scenario.deployment.send_time = Nanoseconds{clock.lockstep ? steps : other};
  for (Participant& p : scenario.deployment.participants) {
    if (dice.chance(25)) {
      p.open = Nanoseconds{std::max<std::int64_t>(0, p.start.count() - clock.scale / 8)};
    }
    if (dice.chance(25)) p.ready = p.start + Nanoseconds{clock.on_grid(clock.scale / 8)};
  }
}

// Two digits are enough.
std::int64_t round_down(std::int64_t t) {
  std::int64_t unit = 1;
  while (t / unit >= 100) unit *= 10;
  return t / unit * unit;
}

}  // namespace

void draw_participants(Dice& dice, const ScenarioSpace& space, int size, Scenario& scenario) {
  std::vector<Participant>& all = scenario.deployment.participants;
  const auto more = (space.max_participants - 2) * static_cast<std::uint32_t>(size) / 100;
  all.resize(2 + dice.count(0, more));
  const std::uint32_t hosts =
      dice.count(2, std::min(most_hosts, static_cast<std::uint32_t>(all.size())));
  const std::uint32_t alike = draw_endpoints(dice, space.max_endpoints);
  const bool equal = dice.chance(30);
  const bool all_hosts = dice.chance(50);
  for (std::uint32_t k = 0; k < all.size(); ++k) {
    Participant& p = all[k];
    p.host.value = all_hosts && k < hosts ? k : dice.count(0, hosts - 1);
    p.publications = equal ? alike : draw_endpoints(dice, space.max_endpoints);
    p.subscriptions = equal ? alike : draw_endpoints(dice, space.max_endpoints);
  }
  if (space.max_endpoints > full_message && dice.chance(10)) {
    all.front().publications = dice.count(full_message, space.max_endpoints);
  }
  if (!scenario.deployment.has_cross_host_pair()) {
    std::uint32_t& host = all.back().host.value;
    host = host == 0 ? 1 : 0;
  }
}

void draw_times(Dice& dice, const ScenarioSpace& space, const Clock& clock, Scenario& scenario) {
  const auto starts = dice.choice<Starts>(4);
  const std::int64_t latest_start = space.max_time_limit.count() / 4;
  const model::ImplementationTraits& traits = model::traits_of(scenario.dds);
  const bool is_creation_alike = dice.chance(30);
  const std::int64_t alike = draw_creation(dice, clock, {});
  std::int64_t latest = 0;
  for (Participant& p : scenario.deployment.participants) {
    p.start = Nanoseconds{std::min(draw_start(dice, clock, starts, latest), latest_start)};
    latest = std::max(latest, p.start.count());
    p.endpoints_done = p.start;
    if (!traits.creates_endpoints_over_time) continue;
    p.endpoints_done += Nanoseconds{is_creation_alike ? alike : draw_creation(dice, clock, p)};
    if (starts != Starts::far_apart) latest = std::max(latest, p.endpoints_done.count());
  }
  if (traits.discovers_same_host) draw_loopback(dice, clock, scenario);
  if (traits.has_event_thread) draw_thread(dice, clock, scenario);
  // Where discovery takes seconds, what follows a few of them is more of the same.
  const std::int64_t longer = std::min(clock.scale * dice.among({1, 2, 4, 8, 16}) / 2,
                                       std::max(2 * clock.scale, 5 * second));
  const std::int64_t limit = std::min(latest + longer, space.max_time_limit.count());
  scenario.time_limit = Nanoseconds{std::max<std::int64_t>(1, round_down(limit))};
  const bool goes_on = dice.chance(15);
  scenario.run_until =
      space.run_until.value_or(goes_on ? model::RunUntil::time_limit : model::RunUntil::completion);
}

}  // namespace stormproof::props
