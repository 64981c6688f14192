// Construction, the dispatch of events and packets to the rules, and what all of them use.
#include "model/fastdds/protocol.hpp"

namespace stormproof::model::fastdds {

Protocol::Protocol(RunState& run, Network& network)
    : DiscoveryBase{run, network, Multicast::last, false},
      changes_{run},
      control_{run, network, *this},
      participants_(run.topology.participant_count()),
      writers_(2 * std::size_t{run.topology.participant_count()}),
      relations_(run.topology.relation_count()),
      known_(run.topology.pair_count(), false) {
  for (std::uint32_t relation = 0; relation < relations_.size(); ++relation) {
    relations_[relation].missing = run.topology.descriptor_count(relation);
  }
  for (std::uint32_t w = 0; w < writers_.size(); ++w) {
    writers_[w].budget = sedp_.piggyback_threshold_bytes.count();
    writers_[w].enqueued.resize(words_for(run.topology.descriptor_count(w / 2, stream_of(w))));
  }
}

void Protocol::start() {
  for (std::uint32_t i = 0; i < run_.topology.participant_count(); ++i) {
    const model::Participant& participant = run_.scenario.deployment.participants[i];
    const std::int64_t start = participant.start.count();
    const std::int64_t span = participant.endpoints_done.count() - start;
    const std::int64_t endpoints = run_.topology.descriptor_count(i, Stream::pub) +
                                   run_.topology.descriptor_count(i, Stream::sub);
    announcements_.start(i);
    for (std::int64_t k = 0; k < endpoints; ++k) {
      run_.schedule(Nanoseconds{start + span * (k + 1) / endpoints}, EventKind::endpoint_creation,
                    i, static_cast<std::uint32_t>(k));
    }
  }
}

void Protocol::handle(const Event& event) {
  const std::uint32_t subject = event.subject;
  switch (event.kind) {
    case EventKind::endpoint_creation:
      create_endpoint(subject, event.detail);
      break;
    case EventKind::nack_response:
      nack_response(subject);
      break;
    case EventKind::suppression_end:
      suppression_end(subject);
      break;
    case EventKind::async_run:
      async_run(subject);
      break;
    case EventKind::control_initial_due:
    case EventKind::control_reply_due:
      control_.handle(event);
      break;
    default:
      DiscoveryBase::handle(event);
      break;
  }
}

std::vector<std::uint32_t> Protocol::receivers(const Packet& packet) const {
  std::vector<std::uint32_t> receivers;
  if (packet.multicast()) {
    for (std::uint32_t pair = run_.topology.first_pair(packet.pair);
         pair < run_.topology.first_pair(packet.pair + 1); ++pair) {
      const Pair& p = run_.topology.pair(pair);
      if (p.cross_host) receivers.push_back(p.destination);
    }
    return receivers;
  }
  const Pair& p = run_.topology.pair(packet.pair);
  receivers.push_back(packet.to_writer() ? p.source : p.destination);
  return receivers;
}

void Protocol::received(const Packet& packet, std::uint32_t receiver) {
  if (run_.now < run_.topology.start(receiver)) return;
  switch (packet.kind) {
    case PacketKind::spdp_multicast:
      spdp_received(run_.topology.pair_between(packet.pair, receiver));
      break;
    case PacketKind::spdp_unicast:
      spdp_received(packet.pair);
      break;
    case PacketKind::data:
      data_received(packet);
      break;
    case PacketKind::heartbeat:
      heartbeat_received(packet.relation(), packet.detail);
      break;
    case PacketKind::acknack:
      acknack_received(packet);
      break;
    case PacketKind::user_heartbeat:
    case PacketKind::user_acknack:
      control_.received(packet);
      break;
  }
}

void Protocol::send(Packet&& packet) {
  const Pair& p = run_.topology.pair(packet.pair);
  const std::uint32_t from = packet.to_writer() ? p.destination : p.source;
  const std::uint32_t to = packet.to_writer() ? p.source : p.destination;
  if (p.cross_host)
    network_.emit(from, std::move(packet));
  else
    network_.loop_back(std::move(packet), to);
}

void Protocol::request(SingleShots& driver, fsm::StateId& timer, Nanoseconds delay, EventKind kind,
                       std::uint32_t subject) {
  const auto output = driver.step<fsm::single_shot::Requested>(
      run_, timer, {.now = run_.now.count(), .delay = delay.count()}, subject);
  if (output.schedule) run_.schedule(Nanoseconds{output.next_at}, kind, subject);
}

bool Protocol::expire(SingleShots& driver, fsm::StateId& timer, std::uint32_t subject) {
  return driver
      .step<fsm::single_shot::Due>(run_, timer, {.now = run_.now.count(), .delay = 0}, subject)
      .fire;
}

std::vector<MissingDescriptor> Protocol::missing(std::size_t limit) {
  return changes_.list_missing(limit);
}

}  // namespace stormproof::model::fastdds
