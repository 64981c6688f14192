// How participants find each other, and how they tell each other of their endpoints.
#include <algorithm>

#include "tests/oracle/cyclone_world.hpp"

namespace stormproof::oracle::cyclone {

namespace {

Message announcement(const World& w, Id i) {
  Message m;
  m.kind = MessageKind::spdp;
  m.owner = i;
  m.bytes = w.multicast ? 372 : 316;
  return m;
}

void notify(World& w, Id j, Id i, int stream, Sample sample) {
  const std::optional<int> topic = topic_writer(stream, sample);
  if (!topic) return;
  const int other = stream == publications ? subscriptions : publications;
  if (!w.participants.at(j).created.contains({other, sample_on(other, *topic)})) return;
  if (stream == publications) {
    open_reader(w, i, *topic, j);
  } else {
    open_writer(w, j, *topic, i);
  }
}

// i knows of j's counterpart of its own new endpoint.
void match_created(World& w, Id i, int stream, int topic, Id j) {
  const int other = stream == publications ? subscriptions : publications;
  const Sample counterpart = sample_on(other, topic);
  if (!w.readers.at({j, other, i}).notified.contains(counterpart)) return;
  if (stream == publications) {
    open_writer(w, i, topic, j);
  } else {
    open_reader(w, j, topic, i);
  }
}

// Nothing is missing below the sample, down to what its writer had at first or to the first one.
bool can_be_told(const World& w, const Reader& r, Sample k) {
  const bool fresh = w.sedp.notification == model::Notification::fresh_at_once &&
                     k > r.first_heard && !w.makes(Mistake::fresh_samples_wait);
  for (Sample lower = fresh ? r.first_heard + 1 : 1; lower <= k; ++lower) {
    if (!r.received.contains(lower)) return false;
  }
  return true;
}

void complete(World& w) {
  w.outcome.completed = true;
  w.outcome.t_disc_ns = w.now;
  if (w.scenario.run_until == model::RunUntil::completion) w.ended = true;
}

}  // namespace

void announce(World& w, Id i) {
  Message m = announcement(w, i);
  m.to.set = true;
  m.to.addresses = {group};
  const bool copies = !w.multicast && !w.makes(Mistake::announces_to_group_only);
  const std::set<Id>& all = w.lives ? w.ever_known[i] : w.participants.at(i).known;
  for (const Id j : all) {
    if (copies) m.to.addresses.push_back(j);
  }
  enqueue(w, i, m);
}

void start(World& w, Id i) {
  announce(w, i);
  move(w, w.participants.at(i).announcement, w.now + w.spdp.startup_period.count());
  if (!w.lives) return;
  Timer liveliness_timer;
  liveliness_timer.kind = TimerKind::liveliness;
  liveliness_timer.owner = i;
  move(w, new_timer(w, liveliness_timer), w.now + liveliness_period(w, i));
}

std::optional<Message> fire_announcement(World& w, const Timer& timer, std::size_t number) {
  const Id i = timer.owner;
  announce(w, i);
  move(w, number, w.now + announcement_period(w, i));
  return {};
}

std::optional<Message> fire_reply(World& w, std::size_t number) {
  Timer& timer = w.timers.at(number);
  if (timer.given_up) return {};
  const Id j = timer.owner;
  Message m = announcement(w, j);
  m.to = only(timer.peer);
  m.directed = true;
  enqueue(w, j, m);
  ++w.timers.at(number).sent;
  const int most = replies_due(w, j);
  if (w.timers.at(number).sent < most) {
    move(w, number, w.now + w.spdp.directed_reply_interval.count());
  }
  return {};
}

void receive_spdp(World& w, Id j, const Message& m) {
  const Id i = m.owner;
  if (!w.participants.at(j).known.insert(i).second) return;
  w.ever_known[j].insert(i);
  begin_lease(w, j, i);
  for (int c = 0; c < builtins; ++c) {
    if (w.makes(Mistake::reader_opens_first)) open_reader(w, i, c, j);
    open_writer(w, j, c, i);
    open_reader(w, i, c, j);
  }
  if (m.directed && !w.makes(Mistake::replies_to_replies)) return;
  if (w.spdp.directed_replies == 0) return;
  Timer reply;
  reply.kind = TimerKind::reply;
  reply.owner = j;
  reply.peer = i;
  move(w, new_timer(w, reply), w.now);
}

void create(World& w, Id i, int stream, Sample sample) {
  Participant& p = w.participants.at(i);
  if (const std::optional<int> topic = topic_writer(stream, sample)) {
    for (Id j = 0; j < w.participants.size(); ++j) {
      if (j != i) match_created(w, i, stream, *topic, j);
    }
  }
  p.created.insert({stream, sample});
  Writer& writer = w.writers.at({i, stream});
  ++writer.history;
  if (writer.readers.empty()) {
    if (!w.makes(Mistake::sent_without_readers)) writer.sent = writer.history;
    return;
  }
  if (!w.makes(Mistake::creation_keeps_n)) writer.n = 0;
  if (!w.makes(Mistake::creation_leaves_timer)) {
    move(w, writer.timer, w.now + w.sedp.heartbeat_interval.count());
  }
  Message m = data_message(w, i, stream, sample);
  m.to = readers_of(w, i, stream);
  enqueue(w, i, m);
}

void receive_data(World& w, Id j, const Message& m) {
  Reader& r = w.readers.at({m.owner, m.writer, j});
  if (!r.open || (!r.seen && !w.makes(Mistake::unseen_data_taken))) return;
  if (!w.makes(Mistake::data_announces_nothing)) r.last = std::max(r.last, m.sample);
  const bool fresh = r.received.insert(m.sample).second;
  if (m.writer > subscriptions) return;
  if (!w.lives && fresh && cross_host(w, m.owner, j) && --w.missing == 0) complete(w);
  if (w.ended) return;
  for (const Sample k : r.received) {
    if (r.notified.contains(k) || !can_be_told(w, r, k)) continue;
    r.notified.insert(k);
    notify(w, j, m.owner, m.writer, k);
  }
}

}  // namespace stormproof::oracle::cyclone
