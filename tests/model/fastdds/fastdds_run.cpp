// The probe behind FastddsLog, and the small scenarios.
#include "tests/model/fastdds/fastdds_run.hpp"

#include <algorithm>
#include <bit>

#include "model/engine/topology.hpp"

namespace stormproof::model::fastdds {

namespace {

constexpr std::int64_t default_endpoints = 17;
constexpr std::int64_t never_ns = 100'000 * sec;

class Recorder final : public Probe {
 public:
  explicit Recorder(FastddsLog& log) : log_{log} {}

  void run_started(const Topology& topology) override { topology_ = &topology; }
  void event_started(const Event& event) override { now_ = event.time.count(); }

  void transition(const MachineRef& machine, std::string_view event, std::string_view before,
                  std::string_view after, std::uint32_t word, std::uint64_t bits) override {
    Move move;
    move.time_ns = now_;
    move.what = std::string{machine.machine} + " " + std::to_string(machine.subject) + ": " +
                std::string{before} + " + " + std::string{event} + " -> " + std::string{after};
    for (; bits != 0; bits &= bits - 1) {
      move.descriptors.push_back(64 * word + static_cast<std::uint32_t>(std::countr_zero(bits)));
    }
    log_.moves.push_back(move);
  }

  void scheduled(std::uint64_t, Nanoseconds time, EventKind kind, std::uint32_t subject) override {
    log_.scheduled.push_back({now_, time.count(), kind, subject});
  }

  void emitted(const Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override {
    Emission emission = describe(packet, source);
    emission.number = packet.number;
    if (!destinations.empty()) emission.destination = destinations[0];
    log_.sent.push_back(emission);
  }

  void looped_back(const Packet& packet, std::uint32_t receiver) override {
    std::uint32_t source = packet.pair;
    if (!packet.multicast()) {
      const Pair& ends = topology_->pair(packet.pair);
      source = packet.to_writer() ? ends.destination : ends.source;
    }
    Emission emission = describe(packet, source);
    emission.destination = receiver;
    emission.looped = true;
    log_.sent.push_back(emission);
  }

  void received(const Packet& packet, std::uint32_t receiver) override {
    log_.received.push_back({now_, packet.number, packet.kind, receiver});
  }

 private:
  [[nodiscard]] Emission describe(const Packet& packet, std::uint32_t source) const {
    Emission emission;
    emission.time_ns = now_;
    emission.kind = packet.kind;
    emission.source = source;
    emission.stream = packet.stream;
    packet.descriptors.for_each([&](std::uint32_t d) { emission.descriptors.push_back(d); });
    emission.bytes = packet.payload_bytes;
    emission.detail = packet.detail;
    emission.heartbeats = packet.heartbeats;
    emission.initial = packet.initial_acknack;
    return emission;
  }

  FastddsLog& log_;
  const Topology* topology_ = nullptr;
  std::int64_t now_ = 0;
};

}  // namespace

std::vector<Emission> FastddsLog::of(PacketKind kind, std::uint32_t source,
                                     std::uint32_t destination, Stream s) const {
  std::vector<Emission> found;
  for (const Emission& packet : sent) {
    if (packet.kind == kind && packet.source == source && packet.destination == destination &&
        packet.stream == s) {
      found.push_back(packet);
    }
  }
  return found;
}

Times FastddsLog::times_of(PacketKind kind, std::uint32_t source, std::uint32_t destination,
                           Stream s) const {
  Times times;
  for (const Emission& packet : of(kind, source, destination, s)) times.push_back(packet.time_ns);
  return times;
}

std::vector<Emission> FastddsLog::at(std::int64_t time_ns, std::uint32_t source) const {
  std::vector<Emission> found;
  for (const Emission& packet : sent) {
    if (packet.time_ns == time_ns && packet.source == source) found.push_back(packet);
  }
  return found;
}

std::uint64_t FastddsLog::number_of_data(std::uint32_t source, std::uint32_t destination,
                                         std::uint32_t d, std::size_t n) const {
  for (const Emission& packet : of(PacketKind::data, source, destination)) {
    const bool carries = std::find(packet.descriptors.begin(), packet.descriptors.end(), d) !=
                         packet.descriptors.end();
    if (carries && n-- == 0) return packet.number;
  }
  return no_number;
}

std::vector<std::pair<std::int64_t, std::int64_t>> FastddsLog::timers(EventKind kind,
                                                                      std::uint32_t subject) const {
  std::vector<std::pair<std::int64_t, std::int64_t>> found;
  for (const Scheduled& event : scheduled) {
    if (event.kind == kind && event.subject == subject)
      found.emplace_back(event.at_ns, event.due_ns);
  }
  return found;
}

std::vector<Move> FastddsLog::moves_of(const std::string& what) const {
  std::vector<Move> found;
  for (const Move& move : moves) {
    if (move.what == what) found.push_back(move);
  }
  return found;
}

FastddsLog run(const Scenario& scenario) {
  FastddsLog log;
  Recorder recorder{log};
  RunOptions options;
  options.probe = &recorder;
  log.result = simulate(scenario, options);
  return log;
}

Scenario fastdds_by_hand(const std::vector<Node>& nodes) {
  Scenario scenario;
  for (const Node& node : nodes) {
    Participant participant;
    participant.host = HostId{node.host};
    participant.publications = node.publications;
    participant.subscriptions = node.subscriptions;
    participant.start = Nanoseconds{node.start_ns};
    const std::int64_t endpoints = default_endpoints + node.publications + node.subscriptions;
    participant.endpoints_done = Nanoseconds{node.start_ns + node.step_ns * endpoints};
    scenario.deployment.participants.push_back(participant);
  }
  scenario.dds.implementation = ImplementationKind::fastdds;
  scenario.dds.spdp.resend = SpdpResend::none;
  scenario.dds.sedp.piggyback = Piggyback::off;
  scenario.wireless.kind = ServiceKind::constant_delay;
  scenario.wireless.one_way = Nanoseconds{ms};
  return scenario;
}

Scenario one_writer(std::int64_t step_ns, std::uint32_t readers) {
  std::vector<Node> nodes{{.host = 0, .start_ns = 0, .step_ns = step_ns}};
  for (std::uint32_t j = 0; j < readers; ++j) {
    nodes.push_back({.host = 1, .start_ns = 0, .step_ns = never_ns});
  }
  return fastdds_by_hand(nodes);
}

}  // namespace stormproof::model::fastdds
