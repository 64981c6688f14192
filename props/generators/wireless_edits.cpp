// Fewer lost and delayed packets, with smaller numbers, and shorter routes.
#include <iterator>

#include "props/generators/edits.hpp"

namespace stormproof::props {

namespace {

using model::Scenario;
using model::Stage;
using Packets = std::vector<std::uint64_t>;

/// So many packets get smaller numbers at a time.
constexpr std::size_t most_renumbered = 16;

/// Sorted again, each once.
void set_lost(Scenario& scenario, Packets packets) {
  std::ranges::sort(packets);
  packets.erase(std::unique(packets.begin(), packets.end()), packets.end());
  scenario.wireless.lost_packets = std::move(packets);
}

Packets without(const Packets& packets, const Packets& gone) {
  Packets rest;
  std::ranges::set_difference(packets, gone, std::back_inserter(rest));
  return rest;
}

/// Lost packets of the scenario that the base does not lose.
void add_loss_edits(const Scenario& scenario, const Scenario& base, Edits& edits) {
  const Packets& usual = base.wireless.lost_packets;
  const Packets& lost = scenario.wireless.lost_packets;
  if (lost == usual) return;
  edits.push_back([usual](Scenario& s) { s.wireless.lost_packets = usual; });
  const Packets extra = without(lost, usual);
  for_parts(extra.size(), [&](std::size_t first, std::size_t last) {
    const Packets gone(extra.begin() + static_cast<std::ptrdiff_t>(first),
                       extra.begin() + static_cast<std::ptrdiff_t>(last));
    edits.push_back([gone](Scenario& s) { set_lost(s, without(s.wireless.lost_packets, gone)); });
  });
  edits.push_back([count = extra.size(), usual](Scenario& s) {
    Packets packets = usual;
    for (std::size_t k = 0; k < count; ++k) packets.push_back(k);
    set_lost(s, packets);
  });
  for (std::size_t k = 0; k < std::min(extra.size(), most_renumbered); ++k) {
    const std::uint64_t packet = extra[k];
    if (packet == 0) continue;
    for (const std::uint64_t smaller : {std::uint64_t{0}, packet / 2, packet - 1}) {
      edits.push_back([packet, smaller](Scenario& s) {
        Packets packets = s.wireless.lost_packets;
        std::ranges::replace(packets, packet, smaller);
        set_lost(s, packets);
      });
    }
  }
}

void add_delay_edits(const Scenario& scenario, const Scenario& base, Edits& edits) {
  const auto& delays = scenario.wireless.packet_delays;
  if (delays == base.wireless.packet_delays) return;
  edits.push_back([&base](Scenario& s) { s.wireless.packet_delays = base.wireless.packet_delays; });
  for_parts(delays.size(), [&](std::size_t first, std::size_t last) {
    edits.push_back([first, last](Scenario& s) {
      auto& list = s.wireless.packet_delays;
      list.erase(list.begin() + static_cast<std::ptrdiff_t>(first),
                 list.begin() + static_cast<std::ptrdiff_t>(last));
    });
  });
  for (std::size_t k = 0; k < std::min(delays.size(), most_renumbered); ++k) {
    const std::uint64_t packet = delays[k].packet;
    if (packet == 0) continue;
    for (const std::uint64_t smaller : {std::uint64_t{0}, packet / 2, packet - 1}) {
      edits.push_back([k, smaller](Scenario& s) { s.wireless.packet_delays[k].packet = smaller; });
    }
  }
}

void remove_overrides(Stage& stage) {
  stage.overhead_unicast.reset();
  stage.overhead_multicast.reset();
  stage.rate_unicast.reset();
  stage.rate_multicast.reset();
}

void add_stage_edits(std::size_t k, Edits& edits) {
  const auto add = [&](auto change) {
    edits.push_back([k, change](Scenario& s) { change(s.wireless.stages[k]); });
  };
  add(remove_overrides);
  add([](Stage& stage) { stage.overhead_unicast.reset(); });
  add([](Stage& stage) { stage.overhead_multicast.reset(); });
  add([](Stage& stage) { stage.rate_unicast.reset(); });
  add([](Stage& stage) { stage.rate_multicast.reset(); });
  edits.push_back(
      [k](Scenario& s) { s.wireless.stages[k].channel = s.wireless.stages.front().channel; });
}

}  // namespace

void add_packet_edits(const Scenario& scenario, const Scenario& base, Edits& edits) {
  add_loss_edits(scenario, base, edits);
  add_delay_edits(scenario, base, edits);
}

void add_route_edits(const Scenario& scenario, const Scenario& base, Edits& edits) {
  const std::size_t size = scenario.wireless.stages.size();
  if (scenario.wireless.stages == base.wireless.stages) return;
  edits.push_back([&base](Scenario& s) { s.wireless.stages = base.wireless.stages; });
  edits.push_back([](Scenario& s) { std::ranges::for_each(s.wireless.stages, remove_overrides); });
  for_parts(size, [&edits](std::size_t first, std::size_t last) {
    edits.push_back([first, last](Scenario& s) {
      auto& stages = s.wireless.stages;
      stages.erase(stages.begin() + static_cast<std::ptrdiff_t>(first),
                   stages.begin() + static_cast<std::ptrdiff_t>(last));
    });
  });
  for (std::size_t k = 0; k < size; ++k) add_stage_edits(k, edits);
}

}  // namespace stormproof::props
