// The probe behind RunLog, and the small scenarios.
#include "tests/model/run_log.hpp"

namespace stormproof::model {

namespace {

class Recorder final : public Probe {
 public:
  explicit Recorder(RunLog& log) : log_{log} {}

  void event_started(const Event& event) override { now_ = event.time.count(); }

  void transition(const Transition& fired) override {
    log_.transitions.push_back(std::string{fired.machine.machine} + " " +
                               std::to_string(fired.machine.subject) + ": " +
                               std::string{fired.before} + " + " + std::string{fired.event} +
                               " -> " + std::string{fired.after});
  }

  void scheduled(std::uint64_t, Nanoseconds time, EventKind kind, std::uint32_t subject) override {
    log_.scheduled.push_back({now_, time.count(), kind, subject});
  }

  void emitted(const Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override {
    Sent sent;
    sent.number = packet.number;
    sent.time_ns = now_;
    sent.kind = packet.kind;
    sent.source = source;
    sent.stream = packet.stream;
    packet.descriptors.for_each([&](std::uint32_t d) { sent.descriptors.push_back(d); });
    sent.payload_bytes = packet.payload_bytes;
    sent.from_repair = packet.from_repair;
    sent.port = packet.port;
    if (destinations.empty()) log_.sent.push_back(sent);
    for (const std::uint32_t destination : destinations) {
      sent.destination = destination;
      log_.sent.push_back(sent);
      ++sent.number;
    }
  }

  void service_started(std::uint32_t channel, std::uint32_t stage, const Packet& packet,
                       std::uint32_t fragment, Nanoseconds until) override {
    log_.services.push_back(
        {now_, until.count(), channel, stage, fragment, packet.number, packet.kind});
  }

  void arrived(const Packet& packet, bool lost) override {
    log_.arrived.push_back({now_, packet.number, lost});
  }

 private:
  RunLog& log_;
  std::int64_t now_ = 0;
};

}  // namespace

std::vector<Sent> RunLog::of(PacketKind kind, std::uint32_t source, std::uint32_t destination,
                             Stream s) const {
  std::vector<Sent> found;
  for (const Sent& packet : sent) {
    if (packet.kind == kind && packet.source == source && packet.destination == destination &&
        packet.stream == s) {
      found.push_back(packet);
    }
  }
  return found;
}

std::vector<std::int64_t> RunLog::times_of(PacketKind kind, std::uint32_t source,
                                           std::uint32_t destination, Stream s) const {
  std::vector<std::int64_t> times;
  for (const Sent& packet : of(kind, source, destination, s)) times.push_back(packet.time_ns);
  return times;
}

std::vector<Scheduled> RunLog::scheduled_of(EventKind kind, std::uint32_t subject) const {
  std::vector<Scheduled> found;
  for (const Scheduled& event : scheduled) {
    if (event.kind == kind && event.subject == subject) found.push_back(event);
  }
  return found;
}

RunLog run_and_log(const Scenario& scenario, const Mutation* mutation) {
  RunLog log;
  Recorder recorder{log};
  RunOptions options;
  options.probe = &recorder;
  options.mutation = mutation;
  log.result = simulate(scenario, options);
  return log;
}

Scenario by_hand(const std::vector<Node>& nodes, std::int64_t one_way_ns) {
  Scenario scenario;
  for (const Node& node : nodes) {
    Participant participant;
    participant.host = HostId{node.host};
    participant.publications = node.publications;
    participant.subscriptions = node.subscriptions;
    participant.start = participant.endpoints_done = Nanoseconds{node.start_ns};
    scenario.deployment.participants.push_back(participant);
  }
  scenario.dds.descriptors.default_publications = 0;
  scenario.dds.descriptors.default_subscriptions = 0;
  scenario.dds.sedp.piggyback = Piggyback::off;
  scenario.wireless.kind = ServiceKind::constant_delay;
  scenario.wireless.one_way = Nanoseconds{one_way_ns};
  return scenario;
}

}  // namespace stormproof::model
