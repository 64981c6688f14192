// Building the scenario of a path and asking the monitor.
#include "checker/engines/explorer/replay.hpp"

#include <algorithm>
#include <vector>

#include <fmt/core.h>

#include "checker/engines/explorer/plan.hpp"
#include "checker/engines/explorer/replayed_packets.hpp"
#include "model/simulator.hpp"
#include "model/trace/replay.hpp"
#include "props/monitors/monitors.hpp"

namespace stormproof::explorer {

namespace {

using model::Nanoseconds;
using model::PacketKind;

/// How long the run goes on from the start of the world: long enough after the path for a monitor
/// to see that nothing follows.
Nanoseconds length_of(const ReplayRequest& request, const ConcretePath& path) {
  const Nanoseconds end = path.steps.empty() ? Nanoseconds{0} : path.steps.back().time;
  return end + (props::has_samples(request.running)
                    ? props::patience_with_cyclone(request.specification)
                    : request.running.dds.sedp.heartbeat_period * 3);
}

constexpr Nanoseconds margin{1'000};  // what exists at the match has been created before

/// Of Cyclone DDS: between two creations of participant 0, so long that none of them is after the
/// start of the world but those of the path. The first publication is the first endpoint, the
/// second one the third.
Nanoseconds endpoint_distance(const ReplayRequest& request, const ConcretePath& path) {
  return length_of(request, path) + margin * 2;
}
std::int64_t last_endpoint(const Scope& scope) { return 2 * scope.descriptors - 1; }

/// When participant 0 has created its last endpoint.
Nanoseconds endpoints_done(const ReplayRequest& request, const ConcretePath& path,
                           Nanoseconds start) {
  if (props::has_samples(request.running)) return endpoint_distance(request, path) * 17;
  if (!creates_over_time(request.running) || request.scope.pushed == 0) return Nanoseconds{0};
  if (request.scope.pushed == 1) {
    const std::int64_t creation = (start + *path.time_of(What::creation)).count();
    return Nanoseconds{(17 * creation + 15) / 16};
  }
  return creation_distance(request.running) * 17;
}

model::Scenario bare_scenario(const ReplayRequest& request, const ConcretePath& path) {
  const Nanoseconds start = start_of_world(request, path);
  model::Scenario scenario;
  scenario.dds = request.running.dds;
  const unsigned subscriptions = request.scope.writers > 1 ? request.scope.descriptors : 0;
  model::Participant writer{model::HostId{0}, request.scope.descriptors, subscriptions, {}, {}};
  if (creates_over_time(request.running)) {
    writer.publications = 0;
    writer.subscriptions = 0;
    writer.endpoints_done = endpoints_done(request, path, start);
    scenario.dds.sedp.piggyback = model::Piggyback::off;
    scenario.deployment.send_time = Nanoseconds{0};
  } else {
    scenario.dds.descriptors.default_publications = 0;
    scenario.dds.descriptors.default_subscriptions = 0;
  }
  scenario.deployment.participants = {writer};
  for (unsigned r = 0; r < request.scope.readers; ++r) {
    const bool joins = r > 0 && request.scope.joins_within.count() > 0;
    const Nanoseconds begin =
        joins ? start + path.time_of(What::reader_opens, r * request.scope.writers)
                            .value_or(Nanoseconds{0})
              : Nanoseconds{0};
    scenario.deployment.participants.push_back({model::HostId{r + 1}, 0, 0, begin, begin});
  }
  if (props::has_samples(scenario)) {  // the reader has nothing to tell as long as the run lasts
    scenario.deployment.participants[1].endpoints_done = writer.endpoints_done * 2;
  }
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = Nanoseconds{0};
  scenario.run_until = model::RunUntil::time_limit;
  scenario.time_limit = start + length_of(request, path);
  return scenario;
}

PacketKind kind_of(What what) {
  if (what == What::data) return PacketKind::data;
  return what == What::heartbeat ? PacketKind::heartbeat : PacketKind::acknack;
}

/// Delays and losses for the packets that a run has emitted so far.
void assign(const ReplayRequest& request, const ConcretePath& path, const PacketList& list,
            model::Scenario& scenario) {
  const Nanoseconds start = start_of_world(request, path);
  auto& delays = scenario.wireless.packet_delays;
  auto& lost = scenario.wireless.lost_packets;
  delays.clear();
  lost.clear();
  for (const PacketList::Entry& packet : list.announcements) {
    const bool by_writer = packet.source == 0;
    const std::uint32_t of =
        (by_writer ? packet.reader : packet.source - 1) * request.scope.writers;
    const Nanoseconds reader = path.time_of(What::reader_opens, of).value_or(Nanoseconds{0});
    const Nanoseconds writer = path.time_of(What::writer_opens, of).value_or(reader);
    const Nanoseconds arrival = std::max(packet.emitted, start + (by_writer ? reader : writer));
    delays.push_back({packet.number, Nanoseconds{0}, arrival - packet.emitted});
  }
  const std::size_t known = std::min(path.packets.size(), list.of_relations.size());
  for (std::size_t k = 0; k < known; ++k) {
    const ConcretePath::Packet& packet = path.packets[k];
    const std::uint64_t number = list.of_relations[k].number;
    if (k > 0 && list.of_relations[k - 1].number == number) continue;  // another part of it
    if (!packet.one_way) lost.push_back(number);
    const Nanoseconds one_way = packet.one_way.value_or(packet.leaves_after);
    delays.push_back({number, std::min(packet.leaves_after, one_way), one_way});
  }
  std::ranges::sort(delays, {}, &model::PacketDelay::packet);
  std::ranges::sort(lost);
}

/// At the same instant, another relation of Cyclone DDS can wake the thread of one participant
/// before that of the other: then the packets of a run are put into the order of the path.
void take_order_of(const ConcretePath& path, std::vector<PacketList::Entry>& packets) {
  const std::size_t known = std::min(path.packets.size(), packets.size());
  for (std::size_t k = 0; k < known; ++k) {
    const bool by_writer = from_writer(path.packets[k].slot.what);
    const auto here = packets.begin() + static_cast<std::ptrdiff_t>(k);
    const auto meant = std::find_if(here, packets.end(), [&](const PacketList::Entry& entry) {
      return from_writer(entry.slot.what) == by_writer;
    });
    if (meant == packets.end() || meant->emitted != here->emitted) continue;
    std::rotate(here, meant, meant + 1);
  }
}

/// Whether the run emitted what the path says.
std::string difference(const ConcretePath& path, const PacketList& list, Nanoseconds start) {
  for (std::size_t k = 0; k < path.packets.size(); ++k) {
    const ConcretePath::Packet& expected = path.packets[k];
    const Nanoseconds time = start + expected.emitted;
    if (k == list.of_relations.size()) {
      return fmt::format("The simulator emits only {} of the path's {} packets.", k,
                         path.packets.size());
    }
    const PacketList::Entry& entry = list.of_relations[k];
    if (entry.emitted == time && entry.is(expected.slot)) continue;
    return fmt::format(
        "Packet {} of the relation is a {} at {} ns in the path and a {} at {} ns "
        "in the simulator.",
        k, name_of(kind_of(expected.slot.what)), time.count(), name_of(kind_of(entry.slot.what)),
        entry.emitted.count());
  }
  return {};
}

}  // namespace

Nanoseconds start_of_world(const ReplayRequest& request, const ConcretePath& path) {
  if (!creates_over_time(request.running)) return Nanoseconds{0};
  const std::int64_t creation = path.time_of(What::creation).value_or(Nanoseconds{0}).count();
  if (props::has_samples(request.running)) {
    const Nanoseconds last = endpoint_distance(request, path) * last_endpoint(request.scope);
    return request.scope.pushed == 0 ? last + margin : last - Nanoseconds{creation};
  }
  if (request.scope.pushed == 0) return margin;
  // The last publication is the 16th of 17 endpoints that are created at equal distances, the last
  // but one is the 15th. Both must be the only ones after the start of the world.
  if (request.scope.pushed == 1) return Nanoseconds{16 * creation} + margin;
  return Nanoseconds{15 * creation_distance(request.running).count() - creation};
}

model::RunResult run(const ReplayRequest& request, const model::Scenario& scenario,
                     model::Probe& probe) {
  constexpr std::uint64_t most_events = 200'000;  // a replay needs a few hundred
  model::RunOptions options;
  options.probe = &probe;
  options.mutation = request.mutation;
  options.max_events = most_events;
  return request.maker == nullptr ? model::simulate(scenario, options)
                                  : model::simulate(scenario, options, *request.maker);
}

std::optional<model::Scenario> scenario_of(const ReplayRequest& request, const ConcretePath& path,
                                           std::string& why_not) {
  model::Scenario scenario = bare_scenario(request, path);
  const Nanoseconds start = start_of_world(request, path);
  // Each round settles at least one more packet or announcement.
  std::size_t announcements = 0;
  for (std::size_t round = 0; round < path.packets.size() + announcements + 20; ++round) {
    PacketList list{request.scope};
    run(request, scenario, list);
    if (props::has_samples(request.running)) take_order_of(path, list.of_relations);
    announcements = list.announcements.size();
    const model::Scenario before = scenario;
    assign(request, path, list, scenario);
    if (scenario == before) {
      why_not = difference(path, list, start);
      if (!why_not.empty()) return std::nullopt;
      return scenario;
    }
  }
  why_not = "The packet numbers of the path's packets do not settle.";
  return std::nullopt;
}

ReplayOutcome replay(const ReplayRequest& request, const ConcretePath& path,
                     std::string_view property) {
  ReplayOutcome outcome;
  const auto scenario = scenario_of(request, path, outcome.why_not);
  if (!scenario) return outcome;
  // The same world, held against the specification.
  model::Scenario specification = *scenario;
  specification.dds = request.specification.dds;
  specification.dds.descriptors = scenario->dds.descriptors;
  const props::MonitorPtr monitor =
      request.bounds.completion ? props::watch_completion(specification, request.bounds.completion)
                                : props::make_monitor(property, specification);
  if (!monitor) {
    outcome.why_not = "There is no monitor that could confirm the violation.";
    return outcome;
  }
  const model::RunResult result = run(request, *scenario, *monitor);
  monitor->finish(model::trace::known_until(result, *scenario));
  if (!monitor->violation()) {
    outcome.why_not = "The monitor does not object to the simulator's run of the path.";
    return outcome;
  }
  const props::Violation& violation = *monitor->violation();
  props::Counterexample example{std::string{property}, *scenario,        violation.event,
                                violation.time,        violation.reason, {}};
  const Nanoseconds start = start_of_world(request, path);
  for (const ConcretePath::Step& step : path.steps) {
    if (start + step.time <= violation.time) {
      example.steps.push_back(step_text(step, request.scope));
    }
  }
  outcome.counterexample = std::move(example);
  return outcome;
}

}  // namespace stormproof::explorer
