// Control-only relations: liveliness and the user data of each topic. They carry no DATA here, but
// their HEARTBEATs and ACKNACKs share the channel with discovery.
#include <algorithm>

#include "tests/oracle/fastdds_world.hpp"

namespace stormproof::oracle::fastdds {

namespace {

model::Nanoseconds reply_delay(const World& w, Id j, int topic) {
  if (is_builtin(topic) && !w.makes(Mistake::builtin_replies_like_user))
    return profile(w, j).version.builtin_response_delay;
  return model::Nanoseconds{5'000'000};
}

Event control_event(EventKind kind, Id j, Id i, int topic) {
  Event event = make_event(kind, j, i, 0);
  event.topic = topic;
  return event;
}

void send(World& w, PacketKind kind, Id from, Id to, int topic, bool initial) {
  const bool is_heartbeat = kind == PacketKind::control_heartbeat;
  send_control(w, kind, from, to, topic, initial,
               is_heartbeat ? heartbeat_payload : acknack_payload);
}

bool has_created(World& w, Id i, int s, int topic) {
  return descriptor_of(s, topic) < writer(w, i, s).existing;
}

// Whether i's endpoint on the topic has been notified at j.
bool is_notified(World& w, Id i, Id j, int s, int topic) {
  if (w.server) {
    const std::vector<bool>& received = relation(w, i, j, s).received;
    return descriptor_of(s, topic) < received.size() && received.at(descriptor_of(s, topic));
  }
  const Relation& r = relation(w, i, j, s);
  const Id d = descriptor_of(s, topic);
  return d < r.handed_over && (!r.waiting.contains(d) || w.makes(Mistake::nobody_waits));
}

void open_liveliness(World& w, Id i, Id j) {
  if (!cross_host(w, i, j)) return;
  open_control_reader(w, i, j, liveliness);
  open_control_writer(w, j, i, liveliness);
}

void open_lookups(World& w, Id i, Id j) {
  if (!asks_for_types_of(w, i, j)) return;
  if (!cross_host(w, i, j) && w.makes(Mistake::no_lookups_on_host)) return;
  const bool writers_first = w.makes(Mistake::lookup_writers_first);
  for (const bool of_writers : {writers_first, !writers_first}) {
    for (const int topic : {questions, answers}) {
      if (of_writers) {
        open_control_writer(w, j, i, topic);
      } else {
        open_control_reader(w, i, j, topic);
      }
    }
  }
}

}  // namespace

Control& control(World& w, Id i, Id j, int topic) { return w.controls[{i, j, topic}]; }

void send_control(World& w, PacketKind kind, Id from, Id to, int topic, bool initial,
                  std::int64_t payload) {
  Packet packet;
  packet.kind = kind;
  packet.source = from;
  packet.destination = to;
  packet.topic = topic;
  packet.port = is_builtin(topic) ? 0 : 1;
  packet.initial = initial;
  packet.payload = payload;
  if (is_lookup(topic) && !initial) {
    const bool is_heartbeat = kind == PacketKind::control_heartbeat;
    packet.sample_count =
        is_heartbeat ? writer(w, from, topic).existing : control(w, to, from, topic).got;
  }
  if (cross_host(w, from, to) || w.makes(Mistake::lookups_on_host_count)) ++w.outcome.user_control;
  emit(w, packet);
}

void open_control_writer(World& w, Id i, Id j, int topic) {
  control(w, i, j, topic).writer_open = true;
  if (is_lookup(topic)) {
    Writer& wr = writer(w, i, topic);
    wr.readers.push_back(j);
    wr.budget = sedp(w, i).piggyback_threshold_bytes.count();
  }
  send(w, PacketKind::control_heartbeat, i, j, topic, false);
}

void open_control_reader(World& w, Id i, Id j, int topic) {
  control(w, i, j, topic).reader_open = true;
  const model::Nanoseconds delay = sedp(w, j).initial_acknack_delay;
  if (delay.count() == 0) return;
  Event event = control_event(EventKind::control_initial, j, i, topic);
  event.number = delay.count();
  schedule_after(w, delay, event);
}

// What j has with i beside the streams, once it knows i.
void open_builtin(World& w, Id i, Id j) {
  if (!w.makes(Mistake::lookups_before_liveliness)) open_liveliness(w, i, j);
  open_lookups(w, i, j);
  if (w.makes(Mistake::lookups_before_liveliness)) open_liveliness(w, i, j);
}

void created(World& w, Id i, int s, Id d) {
  const int topic = topic_of(s, d);
  if (topic == no_topic) return;
  for (Id j = 0; j < w.scenario.deployment.size(); ++j) {
    if (!cross_host(w, i, j) || !is_notified(w, j, i, 1 - s, topic)) continue;
    if (s == pub) {
      open_control_writer(w, i, j, topic);
    } else {
      open_control_reader(w, j, i, topic);
    }
  }
}

void notified(World& w, Id i, Id j, int s, Id d) {
  const int topic = topic_of(s, d);
  if (topic == no_topic || !cross_host(w, i, j) || j == w.scenario.deployment.size()) return;
  if (!has_created(w, j, 1 - s, topic)) return;
  if (s == pub) {
    open_control_reader(w, i, j, topic);
  } else {
    open_control_writer(w, j, i, topic);
  }
}

void receive_control_heartbeat(World& w, const Packet& packet) {
  const Id i = packet.source;
  const Id j = *packet.destination;
  Control& c = control(w, i, j, packet.topic);
  if (!c.reader_open) return;
  c.heartbeat_seen = true;
  if (!w.makes(Mistake::heartbeats_give_nothing)) c.got = std::max(c.got, packet.sample_count);
  if (c.reply_pending && !w.makes(Mistake::control_reply_doubled)) return;
  c.reply_pending = true;
  schedule_after(w, reply_delay(w, j, packet.topic),
                 control_event(EventKind::control_reply, j, i, packet.topic));
}

void receive_control_acknack(World& w, const Packet& packet) {
  const Id i = *packet.destination;
  const Id j = packet.source;
  Control& c = control(w, i, j, packet.topic);
  if (w.makes(Mistake::control_initial_ignored) || !c.writer_open) return;
  if (!packet.initial) {
    c.low = std::max(c.low, packet.sample_count);
    return;
  }
  send(w, PacketKind::control_heartbeat, i, j, packet.topic, false);
  if (!is_lookup(packet.topic)) return;
  writer(w, i, packet.topic).budget = sedp(w, i).piggyback_threshold_bytes.count();
  if (!w.makes(Mistake::initial_arms_no_lookups)) arm_lookups(w, i, packet.topic);
}

void control_reply(World& w, Id j, Id i, int topic) {
  control(w, i, j, topic).reply_pending = false;
  send(w, PacketKind::control_acknack, j, i, topic, false);
}

void control_initial(World& w, Id j, Id i, int topic, Time delay) {
  if (control(w, i, j, topic).heartbeat_seen) return;
  send(w, PacketKind::control_acknack, j, i, topic, true);
  Event again = control_event(EventKind::control_initial, j, i, topic);
  const bool stays = sedp(w, j).initial_acknack_interval == model::InitialAckNackInterval::constant;
  again.number = stays && !w.makes(Mistake::control_always_doubled) ? delay : 2 * delay;
  schedule_after(w, model::Nanoseconds{again.number}, again);
}

}  // namespace stormproof::oracle::fastdds
