// Nested choices, the cheapest innermost. What follows completion is looked at after what
// completes.
#include "checker/experiments/diff/small_scenarios.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "model/implementations.hpp"
#include "props/generators/space.hpp"

namespace stormproof::diff {

namespace {

using model::Deployment;
using model::Nanoseconds;
using model::RunUntil;
using model::Scenario;
using model::WirelessProfile;

constexpr std::int64_t microsecond = 1'000;
constexpr std::int64_t millisecond = 1'000'000;
constexpr std::int64_t second = 1'000'000'000;

constexpr std::array<std::int64_t, 6> delays{millisecond,      100 * microsecond, microsecond,
                                             10 * millisecond, 100 * millisecond, second};
constexpr std::array<std::uint32_t, 5> endpoints_without_loss{0, 1, 2, 20, 400};
constexpr std::array<std::uint32_t, 2> endpoints_with_loss{0, 2};
constexpr std::uint64_t first_packets = 32;  // in which a loss begins
constexpr std::array<RunUntil, 2> run_ends{RunUntil::completion, RunUntil::time_limit};

/// How much later the last participant starts, and how long creating the endpoints takes.
struct Starts {
  std::int64_t later = 0;
  std::int64_t creation = 0;
};
constexpr std::array<Starts, 7> late_starts{{{50 * millisecond, 0},
                                             {300 * millisecond, 0},
                                             {second, 0},
                                             {10 * second, 0},
                                             {0, 20 * millisecond},
                                             {0, 4 * second},
                                             {50 * millisecond, 500 * millisecond}}};

class Series {
 public:
  Series(const SmallScenarios& parts, const Visit& visit) : parts_{parts}, visit_{visit} {}

  bool run(std::uint32_t hosts) {
    return without_losses(hosts) || with_late_starts(hosts) || joining_a_cycle(hosts) ||
           asking_while_suppressed(hosts) || with_losses(hosts);
  }

 private:
  [[nodiscard]] Scenario plain(std::uint32_t hosts, std::uint32_t endpoints) const {
    Scenario scenario = plainest_scenario(parts_);
    scenario.deployment = Deployment::homogeneous(hosts, 1, endpoints);
    return scenario;
  }

  static void start(Scenario& scenario, Starts starts) {
    for (model::Participant& p : scenario.deployment.participants) {
      if (&p == &scenario.deployment.participants.back()) p.start = Nanoseconds{starts.later};
      p.endpoints_done = p.start + Nanoseconds{starts.creation};
    }
    scenario.time_limit += Nanoseconds{starts.later + starts.creation};
  }

  /// On every channel.
  bool on_channels(Scenario scenario) {
    for (const std::int64_t delay : delays) {
      scenario.wireless.one_way = Nanoseconds{delay};
      if (visit_(scenario)) return true;
    }
    scenario.wireless = with_losses_of(parts_.shared, scenario.wireless);
    return visit_(scenario);
  }
  static WirelessProfile with_losses_of(WirelessProfile wireless, const WirelessProfile& lossy) {
    wireless.lost_packets = lossy.lost_packets;
    return wireless;
  }

  bool until_each_end(Scenario scenario) {
    for (const RunUntil end : run_ends) {
      scenario.run_until = end;
      if (on_channels(scenario)) return true;
    }
    return false;
  }

  bool without_losses(std::uint32_t hosts) {
    return std::ranges::any_of(endpoints_without_loss, [&](std::uint32_t endpoints) {
      return until_each_end(plain(hosts, endpoints));
    });
  }

  bool with_late_starts(std::uint32_t hosts) {
    const bool creates_over_time =
        model::traits_of(parts_.implementation).creates_endpoints_over_time;
    for (const std::uint32_t endpoints : {0U, 2U, 60U}) {
      for (const Starts starts : late_starts) {
        if (starts.creation > 0 && !creates_over_time) continue;
        Scenario scenario = plain(hosts, endpoints);
        start(scenario, starts);
        if (until_each_end(scenario)) return true;
      }
    }
    return false;
  }

  /// With the adaptive policy: somebody joins while the HEARTBEATs of a first cycle are answered,
  /// which takes less than the least period. If all have acknowledged everything before, there is
  /// nothing to answer: then a packet has to be lost.
  bool joining_a_cycle(std::uint32_t hosts) {
    const model::SedpProfile& sedp = parts_.base.sedp;
    if (sedp.heartbeat_policy == model::HeartbeatPolicy::periodic) return false;
    for (const std::int64_t fifths : {1, 2}) {
      const Nanoseconds delay{sedp.adaptive.min_period.count() * fifths / 5};
      Scenario scenario = plain(hosts, 0);
      start(scenario, {sedp.heartbeat_period.count() + delay.count() / 2, 0});
      scenario.wireless.one_way = delay;
      if (visit_(scenario) || losing_one_packet(scenario)) return true;
    }
    return false;
  }

  bool losing_one_packet(Scenario scenario) {
    for (std::uint64_t packet = 0; packet < first_packets; ++packet) {
      scenario.wireless.lost_packets = {packet};
      for (const RunUntil end : run_ends) {
        scenario.run_until = end;
        if (visit_(scenario)) return true;
      }
    }
    return false;
  }

  /// DATA is lost, the initial ACKNACK asks for it, and the answer to the first HEARTBEAT asks
  /// again just when the longer suppression of the two profiles run_ends.
  bool asking_while_suppressed(std::uint32_t hosts) {
    const model::SedpProfile& sedp = parts_.base.sedp;
    Scenario scenario = plain(hosts, 0);
    scenario.wireless.one_way = sedp.initial_acknack_delay + sedp.nack_response_delay +
                                parts_.suppression - sedp.heartbeat_response_delay;
    return scenario.wireless.one_way > sedp.initial_acknack_delay && losing_one_packet(scenario);
  }

  /// One packet, then bursts that end later and later.
  bool with_losses(std::uint32_t hosts) {
    for (const std::uint64_t length : {1U, 2U, 4U, 8U, 16U, 32U}) {
      for (std::uint64_t first = 0; first < first_packets; ++first) {
        std::vector<std::uint64_t> lost(length);
        for (std::uint64_t k = 0; k < length; ++k) lost[k] = first + k;
        for (const std::uint32_t endpoints : endpoints_with_loss) {
          for (const RunUntil end : run_ends) {
            Scenario scenario = plain(hosts, endpoints);
            scenario.wireless.lost_packets = lost;
            scenario.run_until = end;
            if (visit_(scenario)) return true;
          }
        }
      }
    }
    return false;
  }

  const SmallScenarios& parts_;
  const Visit& visit_;
};

}  // namespace

Scenario plainest_scenario(const SmallScenarios& parts) {
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(2, 1, 0);
  scenario.dds = parts.base;
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = Nanoseconds{millisecond};
  scenario.time_limit = parts.horizon;
  return scenario;
}

bool visit_small_scenarios(const SmallScenarios& parts, std::uint32_t participants,
                           const Visit& visit) {
  return Series{parts, visit}.run(participants);
}

bool visit_random_scenarios(const SmallScenarios& parts, Crowd crowd, const Visit& visit) {
  props::ScenarioSpace space;
  space.implementation = parts.implementation;
  space.max_endpoints = 20;
  space.max_participants = crowd == Crowd::pair ? 2 : 6;
  const std::uint64_t count = crowd == Crowd::pair ? random_pairs : random_groups;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    const int size = static_cast<int>(100 * seed / count);
    Scenario scenario = props::draw_scenario(seed, size, space);
    scenario.dds = parts.base;
    if (visit(scenario)) return true;
  }
  return false;
}

}  // namespace stormproof::diff
