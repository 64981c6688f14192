// Finds the packet numbers that a director's decisions belong to. What happens to a packet can only
// change what is emitted after it, so running again and again, each time with the decisions about
// all packets of the run before, gets every packet right after at most as many runs as there are
// packets.
#include "checker/engines/timeline/directed_run.hpp"

#include <algorithm>
#include <array>

#include "model/engine/topology.hpp"
#include "model/implementations.hpp"
#include "model/probe.hpp"
#include "model/simulator.hpp"

namespace stormproof::timeline {
namespace {

using model::Nanoseconds;

constexpr Nanoseconds spdp_delay{1};  // of announcements, and of all other relations' packets
constexpr int most_runs = 400;
constexpr std::uint64_t most_events = 20'000;

/// Lists the packets of participant 0's publications to `reader`, and the announcements of
/// participant 0.
class Recorder final : public model::Probe {
 public:
  Recorder(std::uint32_t reader, Nanoseconds opened) : reader_{reader}, opened_{opened} {}

  std::optional<Nanoseconds> completion;  // of the relation
  std::vector<DirectedPacket> packets;
  struct Announcement {
    std::uint64_t number;
    Nanoseconds emitted;
  };
  std::vector<Announcement> announcements;

  void run_started(const model::Topology& topology) override {
    pair_ = topology.pair_between(0, reader_);
    missing_.resize(topology.descriptor_count(0, model::Stream::pub), true);
  }
  void event_started(const model::Event& event) override { now_ = event.time; }
  void received(const model::Packet& packet, std::uint32_t) override {
    if (packet.kind != model::PacketKind::data || packet.pair != pair_ || completion) return;
    packet.descriptors.for_each([&](std::uint32_t d) { missing_[d] = false; });
    if (std::ranges::find(missing_, true) == missing_.end()) completion = now_ - opened_;
  }
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override {
    if (packet.kind == model::PacketKind::spdp_multicast ||
        packet.kind == model::PacketKind::spdp_unicast) {
      for (std::uint32_t copy = 0; copy < packet.copies && source == 0; ++copy) {
        announcements.push_back({packet.number + copy, packet.emitted});
      }
      return;
    }
    const bool discovery = packet.kind == model::PacketKind::data || packet.to_writer() ||
                           packet.kind == model::PacketKind::heartbeat;
    if (!discovery || packet.kind == model::PacketKind::user_acknack ||
        packet.stream != model::Stream::pub) {
      return;
    }
    for (std::uint32_t copy = 0; copy < packet.copies; ++copy) {
      const bool ours =
          packet.copies == 1 ? packet.pair == pair_ : source == 0 && destinations[copy] == reader_;
      if (ours) note(packet, packet.number + copy);
    }
  }

 private:
  void note(const model::Packet& packet, std::uint64_t number) {
    const auto kind = static_cast<std::size_t>(packet.kind);
    const bool acknack = packet.kind == model::PacketKind::acknack;
    packets.push_back({packet.kind, seen_[kind]++, number, packet.initial_acknack,
                       acknack && !packet.descriptors.empty(), packet.emitted - opened_});
  }

  std::uint32_t reader_;
  Nanoseconds opened_;
  std::uint32_t pair_ = 0;
  Nanoseconds now_;
  std::vector<bool> missing_;
  std::array<std::uint32_t, 8> seen_{};
};

/// One publisher on a host of its own, and its reader. For a phase another reader, which opens
/// earlier and so starts the writer's timer.
model::Scenario stage(const Setting& setting) {
  model::Scenario scenario;
  scenario.dds = setting.dds;
  if (model::traits_of(scenario.dds).has_size_knobs) {
    scenario.dds.descriptors.default_publications = 0;
    scenario.dds.descriptors.default_subscriptions = 0;
  } else {
    scenario.dds.descriptors = {};
  }
  scenario.dds.spdp = {};
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = spdp_delay;
  scenario.run_until = setting.run_until;
  model::Participant writer;
  writer.publications = setting.descriptors;
  writer.endpoints_done = setting.endpoints_done;
  model::Participant reader;
  reader.host = model::HostId{1};
  scenario.deployment.participants = {writer, reader};
  if (setting.phase) scenario.deployment.participants.push_back(reader);
  return scenario;
}

/// The later reader hears of the writer at `opened`, whichever announcement tells it.
void direct_announcements(const Recorder& recorder, Nanoseconds opened,
                          std::vector<model::PacketDelay>& delays) {
  for (const auto& [number, emitted] : recorder.announcements) {
    if (number == 0 || emitted >= opened) continue;
    delays.push_back({number, Nanoseconds{0}, opened - emitted});
  }
}

}  // namespace

std::uint64_t DirectedRun::count(model::PacketKind kind) const {
  return static_cast<std::uint64_t>(std::ranges::count(packets, kind, &DirectedPacket::kind));
}

std::optional<DirectedRun> direct(const Setting& setting, const Director& director,
                                  const model::Mutation* mutation) {
  DirectedRun run;
  run.scenario = stage(setting);
  run.opened = spdp_delay;
  if (setting.phase) {
    run.opened += setting.dds.sedp.heartbeat_period - *setting.phase;
    run.scenario.deployment.participants[2].start = run.opened;
  }
  run.scenario.time_limit = run.opened + setting.time_limit;
  for (int attempt = 0; attempt < most_runs; ++attempt) {
    Recorder recorder{setting.phase ? 2U : 1U, run.opened};
    model::RunOptions options;
    options.probe = &recorder;
    options.mutation = mutation;
    options.max_events = most_events;
    run.result = model::simulate(run.scenario, options);
    if (run.result.end == model::RunEnd::interrupted) return std::nullopt;
    run.packets = std::move(recorder.packets);
    run.completion = recorder.completion;

    std::vector<model::PacketDelay> delays;
    std::vector<std::uint64_t> lost;
    if (setting.phase) direct_announcements(recorder, run.opened, delays);
    for (const DirectedPacket& packet : run.packets) {
      const Passing passing = director(packet);
      delays.push_back({packet.number, passing.leaves_after, passing.one_way});
      if (passing.lost) lost.push_back(packet.number);
    }
    std::ranges::sort(delays, {}, &model::PacketDelay::packet);
    std::ranges::sort(lost);
    model::WirelessProfile& wireless = run.scenario.wireless;
    if (delays == wireless.packet_delays && lost == wireless.lost_packets) return run;
    wireless.packet_delays = std::move(delays);
    wireless.lost_packets = std::move(lost);
  }
  return std::nullopt;
}

}  // namespace stormproof::timeline
