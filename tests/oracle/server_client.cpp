// Participants of a deployment with a Discovery Server: how one announces itself to the server,
// when it matches the server's endpoints, and what it learns from the server about the others.
#include <algorithm>

#include "tests/oracle/fastdds_world.hpp"
#include "tests/oracle/oracle_lives.hpp"

namespace stormproof::oracle::fastdds {

namespace {

// By version.
std::int64_t announcement_payload(const World& w) {
  constexpr std::int64_t payloads[] = {324, 568, 572};
  return payloads[static_cast<int>(w.scenario.dds.version.sizes)];
}
constexpr std::int64_t numbers_in_word = 32;
constexpr std::int64_t word_bytes = 4;

Packet to_server(World& w, PacketKind kind, Id i, std::int64_t payload) {
  Packet packet;
  packet.kind = kind;
  packet.source = i;
  packet.destination = w.server_id();
  packet.payload = payload;
  return packet;
}

void announce_to_server(World& w, Id i) {
  if (cross_host(w, i, w.server_id())) ++w.outcome.pdp_data;
  emit(w, to_server(w, PacketKind::registration, i, announcement_payload(w)));
}

void heartbeat_to_server(World& w, Id i) {
  if (cross_host(w, i, w.server_id())) ++w.outcome.pdp_heartbeat;
  emit(w, to_server(w, PacketKind::registration_heartbeat, i, heartbeat_payload));
}

void arm_announcements(World& w, Id i) {
  Registration& r = w.server->clients[i];
  if (r.expiry_pending) return;
  r.expiry_pending = true;
  schedule_after(w, w.scenario.dds.server.pdp_heartbeat_period,
                 make_event(EventKind::client_expiry, i, w.server_id(), participants_stream));
}

void open_learner(World& w, Id j, int stream) {
  w.server->learners[{j, stream}].open = true;
  const model::Nanoseconds delay = w.sedp.initial_acknack_delay;
  if (delay.count() == 0) return;
  Event event = make_event(EventKind::learning_initial, j, w.server_id(), stream);
  event.number = delay.count();
  schedule_after(w, delay, event);
}

void send_acknack(World& w, Id j, int stream, bool initial, std::int64_t base,
                  const std::set<std::int64_t>& request) {
  Packet packet = to_server(w, PacketKind::learning_acknack, j, acknack_payload);
  packet.stream = stream;
  packet.initial = initial;
  packet.number_base = base;
  packet.numbers = request;
  if (!request.empty()) {
    const std::int64_t span = *request.rbegin() - *request.begin() + 1;
    packet.payload += word_bytes * ((span + numbers_in_word - 1) / numbers_in_word);
  }
  if (cross_host(w, j, w.server_id())) {
    ++(stream == participants_stream ? w.outcome.pdp_acknack : w.outcome.acknack);
  }
  emit(w, packet);
}

// The server's own announcement is the first that a client hears that knows only where it is.
void meet_server(World& w, Id i) {
  open_learner(w, i, participants_stream);
  if (w.makes(ServerMistake::meets_silently)) return;
  heartbeat_to_server(w, i);
  if (!w.makes(ServerMistake::greets_once)) arm_announcements(w, i);
}

void learn_participant(World& w, Id j, Id i) {
  if (!w.participants.at(j).known.insert(i).second) return;
  if (i == w.server_id()) w.server->clients[j].knows_server = true;
  open_builtin(w, i, j);
}

void learn_endpoint(World& w, Id j, const Item& item) {
  Relation& r = relation(w, item.participant, j, item.stream);
  if (r.received.at(item.descriptor)) return;
  r.received.at(item.descriptor) = true;
  if (is_needed(w, item.participant, j, item.stream, item.descriptor) && --w.missing == 0) {
    w.outcome.completed = true;
    w.outcome.t_disc_ns = w.now;
    w.ended = w.scenario.run_until == model::RunUntil::completion;
    if (w.ended) return;
  }
  notified(w, item.participant, j, item.stream, item.descriptor);
}

}  // namespace

// Whether discovery is complete only if j has received the descriptor of i.
bool is_needed(const World& w, Id i, Id j, int s, Id d) {
  if (!w.server) return cross_host(w, i, j) && !dies(w.scenario, i) && !dies(w.scenario, j);
  if (w.is_server(i) || w.is_server(j)) return false;
  const int topic = topic_of(s, d);
  return topic != no_topic && descriptor_of(1 - s, topic) < descriptor_count(w.scenario, j, 1 - s);
}

namespace {
void client_announces(World& w, Id i, std::int64_t k) {
  if (k > 0) return announce_to_server(w, i);
  if (knows_guid(w)) {
    open_learner(w, i, participants_stream);
    heartbeat_to_server(w, i);
    announce_to_server(w, i);
    arm_announcements(w, i);
  } else if (w.makes(ServerMistake::announced_at_start)) {
    announce_to_server(w, i);
  }
  schedule_after(w, w.scenario.dds.server.client_sync_period,
                 make_event(EventKind::client_tick, i, w.server_id(), 0));
}
}  // namespace

void announce_to_servers(World& w, Id i, std::int64_t k) {
  const std::vector<std::uint64_t>& own = w.scenario.deployment.participants.at(i).servers;
  for (const auto& [id, server] : w.servers) {
    const std::uint64_t place = id - w.scenario.deployment.size();
    if (!own.empty() && std::find(own.begin(), own.end(), place) == own.end()) continue;
    if (w.makes(ServerMistake::first_server_only) && id != w.servers.begin()->first) continue;
    w.serve(id);
    client_announces(w, i, k);
  }
}

void client_tick(World& w, Id i) {
  if (!w.server->clients[i].knows_server && !w.makes(ServerMistake::matches_at_first_tick)) {
    if (!w.makes(ServerMistake::silent_until_known)) announce_to_server(w, i);
    schedule_after(w, w.scenario.dds.server.client_sync_period,
                   make_event(EventKind::client_tick, i, w.server_id(), 0));
    return;
  }
  for (int s = 0; s < 2; ++s) {
    open_writer(w, i, w.server_id(), s);
    open_learner(w, i, s);
  }
}

void client_expiry(World& w, Id i) {
  Registration& r = w.server->clients[i];
  r.expiry_pending = false;
  if (r.acknowledged || w.makes(ServerMistake::registers_once)) return;
  heartbeat_to_server(w, i);
  arm_announcements(w, i);
}

void receive_registration_acknack(World& w, const Packet& packet) {
  const Id i = *packet.destination;
  if (!packet.initial) {
    w.server->clients[i].acknowledged = true;
    return;
  }
  if (w.makes(ServerMistake::initial_acknowledges)) w.server->clients[i].acknowledged = true;
  const bool answers = knows_guid(w) || w.server->clients[i].knows_server;
  if (!answers && !w.makes(ServerMistake::strangers_answered)) return;
  heartbeat_to_server(w, i);
  arm_announcements(w, i);
}

void receive_relayed(World& w, const Packet& packet) {
  const Id j = *packet.destination;
  Learner& l = w.server->learners[{j, packet.stream}];
  const bool of_server = packet.item && packet.item->stream == participants_stream &&
                         packet.item->participant == w.server_id();
  const bool opens =
      of_server || (packet.stream == participants_stream && w.makes(ServerMistake::anything_opens));
  if (!l.open && !knows_guid(w) && opens) meet_server(w, j);
  if (!l.open) return;
  if (packet.item) {
    l.received.insert(packet.item_number);
    l.announced = std::max(l.announced, packet.item_number);
    if (packet.item->stream == participants_stream) {
      learn_participant(w, j, packet.item->participant);
    } else {
      learn_endpoint(w, j, *packet.item);
    }
    if (w.ended) return;
  }
  if (!w.makes(ServerMistake::gaps_not_received)) {
    l.received.insert(packet.numbers.begin(), packet.numbers.end());
  }
  if (!packet.has_heartbeat) return;
  l.heartbeat_seen = true;
  if (!w.makes(ServerMistake::base_stays)) l.base = std::max(l.base, packet.first);
  if (!w.makes(ServerMistake::heartbeats_announce_nothing)) {
    l.announced = std::max(l.announced, packet.last);
  }
  if (l.acknack_pending) return;
  l.acknack_pending = true;
  const model::Nanoseconds delay = packet.stream == participants_stream
                                       ? w.scenario.dds.server.pdp_heartbeat_response_delay
                                       : w.sedp.heartbeat_response_delay;
  schedule_after(w, delay,
                 make_event(EventKind::learning_acknack, j, w.server_id(), packet.stream));
}

void learning_acknack(World& w, Id j, int stream) {
  Learner& l = w.server->learners[{j, stream}];
  l.acknack_pending = false;
  while (l.received.contains(l.base)) ++l.base;
  std::set<std::int64_t> request;
  for (std::int64_t number = l.base; number <= l.announced; ++number) {
    if (!l.received.contains(number)) request.insert(number);
  }
  send_acknack(w, j, stream, false, l.base, request);
}

void learning_initial(World& w, Id j, int stream, Time delay) {
  if (w.server->learners[{j, stream}].heartbeat_seen) return;
  send_acknack(w, j, stream, true, 0, {});
  Event again = make_event(EventKind::learning_initial, j, w.server_id(), stream);
  const bool stays = w.sedp.initial_acknack_interval == model::InitialAckNackInterval::constant;
  again.number = stays ? delay : 2 * delay;
  schedule_after(w, model::Nanoseconds{again.number}, again);
}

}  // namespace stormproof::oracle::fastdds
