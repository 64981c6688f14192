// Numbers and names of the rows.
#include "model/trace/perfetto_tracks.hpp"

#include "model/cyclone/endpoints.hpp"
#include "model/engine/topology.hpp"
#include "model/implementations.hpp"
#include "model/life.hpp"
#include "model/servers.hpp"
#include "model/trace/event_subject.hpp"
#include "model/trace/json_text.hpp"
#include "model/trace/scenario_names.hpp"

namespace stormproof::model::trace {

namespace {

// Thread numbers begin above all process numbers: a process has a main thread of its own number.
constexpr std::uint32_t first_channel_thread = 10'000;
constexpr std::uint32_t first_participant_thread = 10'100;
static_assert(participant_process(Deployment::max_participants) < first_channel_thread);
static_assert(WirelessProfile::max_stages < first_participant_thread - first_channel_thread);

enum class Row : std::uint8_t {
  participant,
  writer_pub,
  writer_sub,
  reader_pub,
  reader_sub,
  user_topics
};

Track row(std::uint32_t participant, Row row) {
  constexpr std::uint32_t rows = 8;
  return {participant_process(participant),
          first_participant_thread + rows * participant + static_cast<std::uint32_t>(row)};
}

Stream stream_at(std::uint32_t relation_or_writer) {
  return relation_or_writer % 2 == 0 ? Stream::pub : Stream::sub;
}

/// Rows of the two streams; all other writers of a participant share one.
Track endpoint_writer_track(std::uint32_t subject, const Topology& topology) {
  const std::uint32_t stride = cyclone::writers_per_participant(topology);
  const std::uint32_t writer = subject % stride;
  if (writer > cyclone::writer::subscriptions) return user_track(subject / stride);
  return writer_track(subject / stride, stream_at(writer));
}
Track endpoint_relation_track(std::uint32_t subject, const Topology& topology, bool of_reader) {
  const std::uint32_t stride = cyclone::writers_per_participant(topology);
  const Pair& pair = topology.pair(subject / stride);
  const std::uint32_t participant = of_reader ? pair.destination : pair.source;
  const std::uint32_t writer = subject % stride;
  if (writer > cyclone::writer::subscriptions) return user_track(participant);
  return of_reader ? reader_track(participant, stream_at(writer))
                   : writer_track(participant, stream_at(writer));
}

}  // namespace

Track channel_track(std::uint32_t channel) {
  return {network_process, first_channel_thread + channel};
}

Track participant_track(std::uint32_t participant) { return row(participant, Row::participant); }

Track writer_track(std::uint32_t participant, Stream stream) {
  return row(participant, stream == Stream::pub ? Row::writer_pub : Row::writer_sub);
}

Track reader_track(std::uint32_t participant, Stream stream) {
  return row(participant, stream == Stream::pub ? Row::reader_pub : Row::reader_sub);
}

Track user_track(std::uint32_t participant) { return row(participant, Row::user_topics); }

Track sender_track(const Packet& packet, std::uint32_t source) {
  switch (packet.kind) {
    case PacketKind::spdp_multicast:
    case PacketKind::spdp_unicast:
    case PacketKind::rtps_message:
    case PacketKind::registration:
    case PacketKind::registration_heartbeat:
    case PacketKind::registration_acknack:
    case PacketKind::relayed:
    case PacketKind::relayed_acknack:
      return participant_track(source);
    case PacketKind::acknack:
      return reader_track(source, packet.stream);
    case PacketKind::data:
    case PacketKind::heartbeat:
      return writer_track(source, packet.stream);
    default:
      return user_track(source);
  }
}

Track receiver_track(const Packet& packet, std::uint32_t destination) {
  switch (packet.kind) {
    case PacketKind::spdp_multicast:
    case PacketKind::spdp_unicast:
    case PacketKind::rtps_message:
    case PacketKind::registration:
    case PacketKind::registration_heartbeat:
    case PacketKind::registration_acknack:
    case PacketKind::relayed:
    case PacketKind::relayed_acknack:
      return participant_track(destination);
    case PacketKind::acknack:
      return writer_track(destination, packet.stream);
    case PacketKind::data:
    case PacketKind::heartbeat:
      return reader_track(destination, packet.stream);
    default:
      return user_track(destination);
  }
}

std::optional<Track> machine_track(const MachineRef& machine, const Topology& topology) {
  const std::uint32_t subject = machine.subject;
  if (machine.machine == "SingleShot" || machine.machine == "MovableTimer") return std::nullopt;
  switch (machine.kind) {
    case MachineRef::Kind::participant:
      return participant_track(subject);
    case MachineRef::Kind::writer:
      return writer_track(subject / 2, stream_at(subject));
    case MachineRef::Kind::channel:
    case MachineRef::Kind::control_relation:
    case MachineRef::Kind::control_writer:
    case MachineRef::Kind::pair:
      return std::nullopt;
    case MachineRef::Kind::endpoint_writer:
      return endpoint_writer_track(subject, topology);
    case MachineRef::Kind::endpoint_relation:
      return machine.machine == "MatchedReader"
                 ? endpoint_relation_track(subject, topology, /*of_reader=*/false)
                 : endpoint_relation_track(subject, topology, /*of_reader=*/true);
    case MachineRef::Kind::relation:
      break;
  }
  const Pair& pair = topology.pair(subject / 2);
  const bool of_reader =
      machine.machine == "DiscoveryReader" || machine.machine == "InitialAckNack";
  if (of_reader) return reader_track(pair.destination, stream_at(subject));
  return writer_track(pair.source, stream_at(subject));
}

bool is_timer(EventKind kind) {
  const Subject subject = subject_of(kind);
  return subject == Subject::participant || subject == Subject::writer ||
         subject == Subject::relation || subject == Subject::pair ||
         subject == Subject::endpoint_writer || subject == Subject::endpoint_relation;
}

Track timer_track(EventKind kind, std::uint32_t subject, const Topology& topology) {
  switch (subject_of(kind)) {
    case Subject::participant:
      return participant_track(subject);
    case Subject::writer:
      return writer_track(subject / 2, stream_at(subject));
    case Subject::pair:
      return participant_track(topology.pair(subject).source);
    case Subject::endpoint_writer:
      return endpoint_writer_track(subject, topology);
    case Subject::endpoint_relation:
      return endpoint_relation_track(subject, topology, /*of_reader=*/true);
    default:
      break;
  }
  const Pair& pair = topology.pair(subject / 2);
  const bool of_reader =
      kind == EventKind::acknack_generation || kind == EventKind::initial_acknack_due;
  if (of_reader) return reader_track(pair.destination, stream_at(subject));
  return writer_track(pair.source, stream_at(subject));
}

void name_tracks(PerfettoEvents& events, const Scenario& scenario) {
  events.process_name(network_process, "network");
  const std::vector<std::string> channels = channel_names(scenario);
  for (std::uint32_t c = 0; c < channels.size(); ++c) {
    events.thread_name(channel_track(c), "channel " + channels[c]);
  }
  const bool user_topics = traits_of(scenario.dds).has_control_relations;
  const Deployment& deployment = scenario.deployment;
  const std::uint32_t servers = traits_of(scenario.dds).has_server ? server_count(deployment) : 0;
  for (std::uint32_t i = 0; i < deployment.size() + servers; ++i) {
    const bool is_server = i >= deployment.size();
    std::string name;
    append(name, is_server ? "server " : "participant ", i, " (host ", host_of(deployment, i).value,
           ")");
    events.process_name(participant_process(i), name);
    events.thread_name(participant_track(i), "participant");
    events.thread_name(writer_track(i, Stream::pub), "publications writer");
    events.thread_name(writer_track(i, Stream::sub), "subscriptions writer");
    events.thread_name(reader_track(i, Stream::pub), "publications reader");
    events.thread_name(reader_track(i, Stream::sub), "subscriptions reader");
    if (user_topics) events.thread_name(user_track(i), "user topics");
  }
}

}  // namespace stormproof::model::trace
