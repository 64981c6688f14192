// The Discovery Server apart from its writers: how it takes in clients and descriptors, and the
// routine that finds out who has to learn what.
#include <algorithm>

#include "tests/oracle/fastdds_world.hpp"

namespace stormproof::oracle::fastdds {

namespace {

Item announcement_of(Id i) { return {i, participants_stream, 0}; }

void wake(World& w) {
  // Whatever is scheduled for later does not count any more.
  if (!w.makes(ServerMistake::periodic_run_stays)) ++w.server->token;
  if (w.server->routine_pending) return;
  w.server->routine_pending = true;
  schedule(w, w.now, EventClass::protocol,
           make_event(EventKind::routine, w.server_id(), w.server_id(), 0));
}

void send_registration_acknack(World& w, Id i, bool initial) {
  Packet packet;
  packet.kind = PacketKind::registration_acknack;
  packet.source = w.server_id();
  packet.destination = i;
  packet.initial = initial;
  packet.payload = acknack_payload;
  if (cross_host(w, i, w.server_id())) ++w.outcome.pdp_acknack;
  emit(w, packet);
}

void schedule_initial(World& w, Id i, Time delay) {
  if (delay == 0) return;
  Event event = make_event(EventKind::registration_initial, w.server_id(), i, participants_stream);
  event.number = delay;
  schedule_after(w, model::Nanoseconds{delay}, event);
}

// Shared topics come first, then rosout, then those that only one participant has.
Server::TopicKey topic_key(const Item& item) {
  const int shared = topic_of(item.stream, item.descriptor);
  if (shared != no_topic) return {0, static_cast<Id>(shared), 0, 0};
  if (item.stream == pub && item.descriptor == 1) return {1, 0, 0, 0};
  return {2, item.participant, item.stream, item.descriptor};
}

void make_dirty(Server& server, const Server::TopicKey& key) {
  if (std::find(server.dirty.begin(), server.dirty.end(), key) == server.dirty.end()) {
    server.dirty.push_back(key);
  }
}

void mark(Server& server, const Item& item, Id j) {
  server.marked.insert({item, j});
  server.marked.insert({announcement_of(item.participant), j});
}

// Returns whether some reader that the item is relevant for has not acknowledged it.
bool note(World& w, int stream, std::int64_t number, const Item& item) {
  Server& server = *w.server;
  const Relay& relay = server.relays[stream];
  bool pending = false;
  for (const Id j : relay.readers) {
    if (!is_relevant(w, item, j)) continue;
    const RelayReader& about = relay.about.at(j);
    if (number <= about.low || !about.list.contains(number)) {
      server.noted.insert({item, j});
    } else {
      pending = true;
    }
  }
  return pending;
}

void note_acknowledgements(World& w) {
  Server& server = *w.server;
  for (const int stream : {1, 0, 2}) {
    const std::map<std::int64_t, Item> history = server.relays[stream].history;
    for (const auto& [number, item] : history) {
      const bool own = item == announcement_of(w.server_id());
      if (own && server.all_noted) continue;
      if (note(w, stream, number, item)) continue;
      if (own) {
        server.all_noted = true;
      } else {
        remove(w, stream, item);
      }
    }
  }
}

void take_participants(World& w, std::vector<Item>& announcements) {
  Server& server = *w.server;
  const bool super = w.scenario.dds.discovery == model::Discovery::super_client;
  for (const Id i : server.joining) {
    ++server.news;
    if (!w.makes(ServerMistake::all_noted_for_good)) server.all_noted = false;
    if (!super) continue;
    for (const auto& [key, topic] : server.topics) {
      for (const auto* list : {&topic.publications, &topic.subscriptions}) {
        for (const Item& item : *list) {
          if (item.participant != i) mark(server, item, i);
        }
      }
      if (!w.makes(ServerMistake::known_topics_stay_clean)) make_dirty(server, key);
    }
    server.supers.push_back(i);
    if (w.makes(ServerMistake::own_announcement_once)) continue;
    const Item own = announcement_of(w.server_id());
    if (std::find(announcements.begin(), announcements.end(), own) == announcements.end()) {
      announcements.insert(announcements.begin(), own);
    }
  }
  server.joining.clear();
}

void take_endpoints(Server& server) {
  for (const Item& item : server.arrived) {
    const Server::TopicKey key = topic_key(item);
    Topic& topic = server.topics[key];
    (item.stream == pub ? topic.publications : topic.subscriptions).push_back(item);
    ++server.news;
    for (const Item& other : item.stream == pub ? topic.subscriptions : topic.publications) {
      if (other.participant == item.participant) continue;
      mark(server, item, other.participant);
      mark(server, other, item.participant);
    }
    for (const Id j : server.supers) {
      if (j != item.participant) mark(server, item, j);
    }
    make_dirty(server, key);
  }
  server.arrived.clear();
}

/// What one run of the routine is going to send.
struct Lists {
  std::vector<Item> announcements;
  std::vector<Item> publications;
  std::vector<Item> subscriptions;
};

void join(World& w, std::vector<Item>& list, const Item& item, Id j) {
  Server& server = *w.server;
  const bool once = w.scenario.dds.server.relay == model::Relay::once;
  if (once && server.waiting.contains({item, j})) return;
  if (once && w.makes(ServerMistake::waiting_for_all)) server.waiting.insert({item, j});
  if (std::find(list.begin(), list.end(), item) != list.end()) return;
  list.push_back(item);
  if (once) server.waiting.insert({item, j});
}

// Returns whether the topic of the item stays dirty.
bool check(World& w, Lists& lists, const Item& item, Id j) {
  Server& server = *w.server;
  const Item announcement = announcement_of(item.participant);
  if (item.participant == j || !server.marked.contains({announcement, j})) return false;
  if (!server.noted.contains({announcement, j})) {
    join(w, lists.announcements, announcement, j);
    if (!w.makes(ServerMistake::participants_need_no_notice)) {
      return !w.makes(ServerMistake::topics_looked_at_once);
    }
  }
  if (server.marked.contains({item, j}) && !server.noted.contains({item, j})) {
    join(w, item.stream == pub ? lists.publications : lists.subscriptions, item, j);
  }
  return false;
}

bool check_topic(World& w, Lists& lists, const Topic& topic) {
  bool stays = false;
  const std::vector<Id>& supers = w.server->supers;
  for (const Item& publication : topic.publications) {
    for (const Item& subscription : topic.subscriptions) {
      stays |= check(w, lists, subscription, publication.participant);
      stays |= check(w, lists, publication, subscription.participant);
    }
    for (const Id j : supers) stays |= check(w, lists, publication, j);
  }
  for (const Id j : supers) {
    for (const Item& subscription : topic.subscriptions) stays |= check(w, lists, subscription, j);
  }
  return stays;
}

}  // namespace

bool is_relevant(const World& w, const Item& item, Id j) {
  const Server& server = *w.server;
  const Item announcement = announcement_of(item.participant);
  if (item.participant == w.server_id()) return true;
  if (!server.marked.contains({item, j}) || server.noted.contains({item, j})) return false;
  if (item.stream == participants_stream) return true;
  return server.marked.contains({announcement, j}) &&
         (server.noted.contains({announcement, j}) ||
          w.makes(ServerMistake::participants_need_no_notice));
}

void receive_registration(World& w, const Packet& packet) {
  const Id i = packet.source;
  const Id n = w.server_id();
  Registration& r = w.server->clients[i];
  if (r.joined) return;
  r.joined = true;
  w.server->joining.push_back(i);
  schedule_initial(w, i, w.sedp.initial_acknack_delay.count());
  open_relay(w, participants_stream, i);
  const bool builtin_first = !knows_guid(w) && !w.makes(ServerMistake::builtin_last);
  if (builtin_first) open_builtin(w, i, n);
  const bool answers = !knows_guid(w) && !w.makes(ServerMistake::waits_for_routine);
  const bool answers_first = w.makes(ServerMistake::answers_before_relays);
  if (answers && answers_first) send_own_announcement(w, i);
  for (int s = 0; s < 2; ++s) open_reader(w, n, i, s);
  for (int s = 0; s < 2; ++s) open_relay(w, s, i);
  if (!builtin_first) open_builtin(w, i, n);
  if (answers && !answers_first) send_own_announcement(w, i);
  wake(w);
}

void receive_registration_heartbeat(World& w, Id i) {
  Registration& r = w.server->clients[i];
  if (!r.joined) return;
  r.heartbeat_seen = true;
  if (r.reply_pending) return;
  r.reply_pending = true;
  schedule_after(w, w.scenario.dds.server.pdp_heartbeat_response_delay,
                 make_event(EventKind::registration_acknack, w.server_id(), i, 2));
}

void registration_acknack(World& w, Id i) {
  w.server->clients[i].reply_pending = false;
  send_registration_acknack(w, i, false);
}

void registration_initial(World& w, Id i, Time delay) {
  if (w.server->clients[i].heartbeat_seen) return;
  send_registration_acknack(w, i, true);
  const bool stays = w.sedp.initial_acknack_interval == model::InitialAckNackInterval::constant;
  schedule_initial(w, i, stays ? delay : 2 * delay);
}

void server_learns(World& w, Id i, int s, const std::vector<Id>& descriptors) {
  for (const Id d : descriptors) w.server->arrived.push_back({i, s, d});
  if (!descriptors.empty()) wake(w);
}

void routine(World& w, std::uint64_t token) {
  Server& server = *w.server;
  if (token > 0 && token != server.token) return;
  if (token == 0) server.routine_pending = false;
  Lists lists;
  note_acknowledgements(w);
  take_participants(w, lists.announcements);
  take_endpoints(server);
  std::vector<Server::TopicKey> dirty;
  for (const Server::TopicKey& key : server.dirty) {
    const bool stays = check_topic(w, lists, server.topics[key]);
    if (stays || w.makes(ServerMistake::everything_is_looked_at)) dirty.push_back(key);
  }
  server.dirty = dirty;
  if (server.news > 0 || w.makes(ServerMistake::announced_without_news)) {
    for (const Item& item : lists.announcements) insert(w, participants_stream, item);
  }
  server.news = 0;
  for (const Item& item : lists.publications) insert(w, pub, item);
  for (const Item& item : lists.subscriptions) insert(w, sub, item);
  const bool idle = server.all_noted && server.relays[2].history.size() == 1 &&
                    server.relays[0].history.empty() && server.relays[1].history.empty();
  if (idle) return;
  Event event = make_event(EventKind::routine, w.server_id(), w.server_id(), 0);
  event.token = ++server.token;
  schedule_after(w, w.scenario.dds.server.server_routine_period, event);
}

}  // namespace stormproof::oracle::fastdds
