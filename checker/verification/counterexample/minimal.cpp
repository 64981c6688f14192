// Greedy: the first simpler scenario that breaks it as early is taken, and the search starts over.
#include "checker/verification/counterexample/minimal.hpp"

#include <algorithm>

#include "checker/verification/counterexample/observe.hpp"
#include "props/generators/simpler.hpp"

namespace stormproof::counterexample {

namespace {

/// Events of all runs together: the search ends at the same place on every machine.
constexpr std::uint64_t budget = 2'000'000;

/// No packet has a fate that it did not have: delays stay within what the engine looked at.
bool is_part_of(const model::WirelessProfile& less, const model::WirelessProfile& whole) {
  const auto had = [&](const model::PacketDelay& delay) {
    return std::ranges::find(whole.packet_delays, delay) != whole.packet_delays.end();
  };
  return less.one_way == whole.one_way && std::ranges::all_of(less.packet_delays, had) &&
         std::ranges::includes(whole.lost_packets, less.lost_packets);
}

}  // namespace

props::Counterexample minimal(props::Counterexample found, const std::function<bool()>& goes_on) {
  // The same rules, over a network that treats all packets alike.
  model::Scenario base = found.scenario;
  base.wireless.lost_packets.clear();
  base.wireless.packet_delays.clear();
  std::uint64_t left = budget;
  const auto breaks_too = [&](const model::Scenario& simpler) {
    if (!is_part_of(simpler.wireless, found.scenario.wireless)) return false;
    const std::uint64_t most = std::min(found.event + 1, left);
    if (most == 0 || (goes_on && !goes_on())) return false;
    left -= most;
    const auto monitor = props::make_monitor(found.property, simpler);
    if (!monitor) return false;
    const auto violation = observe(simpler, *monitor, nullptr, most);
    if (!violation || violation->event > found.event) return false;
    if (simpler != found.scenario) found.steps.clear();  // they tell another story
    found.scenario = simpler;
    found.event = violation->event;
    found.time = violation->time;
    found.reason = violation->reason;
    return true;
  };
  while (props::first_simpler(model::Scenario{found.scenario}, base, breaks_too)) {
  }
  return found;
}

}  // namespace stormproof::counterexample
