// Participants of `implementation: fastdds` that were there before the run, fall silent, are out of
// reach, are forgotten, or come back (specs/guide/museum.md, "Participants that forget"). An event
// is of the epoch in which it was scheduled: who has been forgotten since, or has come back, has
// nothing to do with it.
#include <algorithm>

#include "tests/oracle/fastdds_world.hpp"
#include "tests/oracle/oracle_lives.hpp"

namespace stormproof::oracle::fastdds {

namespace {

model::Life life_of(const World& w) { return w.scenario.deployment.life.value_or(model::Life{}); }

bool existed_before(const World& w, Id i) {
  const model::Life life = life_of(w);
  for (const model::StaleRelation& stale : life.stale) {
    if (stale.writer == i) return true;
  }
  return false;
}

// j, who does not die, is not to know i, who does.
bool holds_in_vain(const World& w, Id i, Id j) {
  const bool cross = w.participants.at(i).host != w.participants.at(j).host;
  return cross && dies(w.scenario, i) && !dies(w.scenario, j);
}

void forget_topics(World& w, Id i, Id j) {
  if (w.makes(Mistake::topics_remembered)) return;
  for (auto& [key, control] : w.controls) {
    const auto& [source, destination, topic] = key;
    if (source == i && destination == j) {
      control.reader_open = false;
      control.heartbeat_seen = false;
      control.reply_pending = false;
      ++control.epoch;
    }
    if (source == j && destination == i) control.writer_open = false;
  }
}

void close_writer(World& w, Id j, Id i, int s) {
  Relation& out = relation(w, j, i, s);
  Writer& wr = writer(w, j, s);
  std::erase(wr.readers, i);
  for (std::vector<Id>& batch : wr.batches) std::erase(batch, i);
  wr.cycle_readers.erase(i);
  wr.responded.erase(i);
  out.writer_open = false;
  out.state.assign(out.state.size(), DescriptorState::unsent);
  out.delivered.assign(out.delivered.size(), false);
  out.low = 0;
  out.suppression_pending = false;
  ++out.writer_epoch;
}

// j forgets i: what it had of i, and what it knew of i as its reader.
void forget(World& w, Id i, Id j) {
  if (w.participants.at(j).known.erase(i) > 0 && holds_in_vain(w, i, j) &&
      !w.makes(Mistake::holds_the_dead)) {
    --w.missing;
  };
  w.participants.at(j).forgets.erase(i);
  ++w.lease_epochs[{i, j}];
  for (int s = 0; s < 2; ++s) {
    Relation& in = relation(w, i, j, s);
    in.reader_open = false;
    in.heartbeat_seen = false;
    in.acknack_pending = false;
    in.announced = 0;
    in.handed_over = 0;
    for (Id d = 0; d < in.received.size(); ++d) {
      if (!in.received.at(d) || !is_needed(w, i, j, s, d)) continue;
      ++w.missing;
      w.outcome.completed = false;
      w.outcome.t_disc_ns = -1;
    }
    in.received.assign(in.received.size(), false);
    ++in.reader_epoch;
    if (!w.makes(Mistake::forgets_reader_only)) close_writer(w, j, i, s);
  }
  forget_topics(w, i, j);
}

// Before the run i exists, has all of j and takes j for up to date; j knows nothing of i.
void open_before(World& w, Id i, Id j) {
  get_to_know(w, j, i);
  heard(w, i, j);
  for (int s = 0; s < 2; ++s) {
    const Id count = descriptor_count(w.scenario, i, s);
    writer(w, i, s).existing = count;
    Relation& out = relation(w, i, j, s);
    if (!out.writer_open) writer(w, i, s).readers.push_back(j);
    out.writer_open = true;
    out.state.assign(out.state.size(), DescriptorState::acknowledged);
    out.low = count;
    Relation& in = relation(w, j, i, s);
    in.reader_open = true;
    in.heartbeat_seen = true;
    in.announced = descriptor_count(w.scenario, j, s);
    in.handed_over = in.announced;
    for (Id d = 0; d < in.received.size(); ++d) {
      if (!in.received.at(d) && is_needed(w, j, i, s, d)) --w.missing;
      in.received.at(d) = true;
    }
  }
  for (const auto& [from, to] : {std::pair{i, j}, std::pair{j, i}}) {
    const auto open = [&w, i, from = from, to = to](int topic) {
      Control& control = w.controls[{from, to, topic}];
      if (from == i) {
        control.writer_open = true;
      } else {
        control.reader_open = true;
        control.heartbeat_seen = true;
      }
    };
    for (int topic = liveliness;; ++topic) {
      const bool exists = topic == liveliness ||
                          (descriptor_of(pub, topic) < descriptor_count(w.scenario, from, pub) &&
                           descriptor_of(sub, topic) < descriptor_count(w.scenario, to, sub));
      if (!exists) break;
      open(topic);
    }
    if (!asks_for_types_of(w, i, j)) continue;
    for (const int topic : {questions, answers}) open(topic);
  }
}

Event lease_event(Id i, Id j) { return make_event(EventKind::lease_check, i, j, 0); }

}  // namespace

void begin_life(World& w) {
  if (!w.scenario.deployment.life) return;
  if (!w.makes(Mistake::ends_before_settled)) w.settled = settled(w.scenario);
  for (const model::StaleRelation& stale : life_of(w).stale) {
    open_before(w, stale.writer, stale.reader);
  }
  if (w.missing > 0) return;
  w.outcome.completed = true;
  w.outcome.t_disc_ns = 0;
  w.ended = ends_complete(w);
}

std::int64_t count_held_in_vain(const World& w) {
  std::int64_t count = 0;
  for (Id j = 0; j < w.participants.size(); ++j) {
    for (const Id i : w.participants.at(j).known) count += holds_in_vain(w, i, j) ? 1 : 0;
  }
  return count;
}

void get_to_know(World& w, Id i, Id j) {
  const bool is_new = w.participants.at(j).known.insert(i).second;
  if (!is_new || !holds_in_vain(w, i, j) || w.makes(Mistake::holds_the_dead)) return;
  ++w.missing;
  w.outcome.completed = false;
  w.outcome.t_disc_ns = -1;
}

void schedule_returns(World& w) {
  for (const model::Restart& back : life_of(w).restarts) {
    if (back.identity == model::Identity::fresh) continue;
    const Id i = back.participant;
    schedule(w, back.start.count(), EventClass::protocol,
             make_event(EventKind::participant_return, i, i, 0));
  }
}

bool ends_complete(const World& w) {
  return w.missing == 0 && w.now >= w.settled &&
         w.scenario.run_until == model::RunUntil::completion;
}

bool is_away(const World& w, Id i, Time at) { return oracle::is_away(w.scenario, i, at); }

bool is_heard(const World& w, const Packet& packet, Id j) {
  if (!w.scenario.deployment.life) return true;
  if (is_away(w, packet.source, packet.emitted) || is_away(w, j, w.now)) return false;
  if (!is_ready(w.scenario, j, w.now) && !w.makes(Mistake::hears_unready)) return false;
  return !is_cut_off(w.scenario, packet.source, j, w.now) || w.makes(Mistake::hears_in_outages);
}

int epoch_of(World& w, const Event& e) {
  switch (e.kind) {
    case EventKind::announcement:
    case EventKind::creation:
    case EventKind::nack_response:
    case EventKind::async_run:
    case EventKind::heartbeat_expiry:
    case EventKind::cycle_start:
    case EventKind::cycle_end:
    case EventKind::cycle_batch:
      return w.participants.at(e.from).lives;
    case EventKind::initial_acknack:
    case EventKind::acknack_generation:
      return relation(w, e.to, e.from, e.stream).reader_epoch;
    case EventKind::suppression_end:
      return relation(w, e.from, e.to, e.stream).writer_epoch;
    case EventKind::control_initial:
    case EventKind::control_reply:
      return w.controls[{e.to, e.from, e.topic}].epoch;
    case EventKind::lease_check:
      return w.lease_epochs[{e.from, e.to}];
    default:
      return 0;
  }
}

bool is_void(World& w, EventClass event_class, const Event& e) {
  if (!w.scenario.deployment.life || event_class != EventClass::protocol) return false;
  if (e.epoch != epoch_of(w, e) && !w.makes(Mistake::forgotten_events_happen)) return true;
  if (e.kind == EventKind::creation && e.epoch == 0 && existed_before(w, e.from)) return true;
  return is_away(w, e.kind == EventKind::lease_check ? e.to : e.from, w.now);
}

// Something of i has reached j.
void heard(World& w, Id j, Id i) {
  if (!w.scenario.deployment.life) return;
  const Time lease = lease_of(w.scenario, i);
  Participant& p = w.participants.at(j);
  if (lease == 0 || !p.known.contains(i)) return;
  const bool is_checked = p.forgets.contains(i);
  if (is_checked && w.makes(Mistake::lease_not_renewed)) return;
  p.forgets[i] = w.now + lease;
  if (!is_checked) schedule(w, w.now + lease, EventClass::protocol, lease_event(i, j));
}

void lease_check(World& w, Id i, Id j) {
  const Time end = w.participants.at(j).forgets.at(i);
  if (w.now >= end) return forget(w, i, j);
  schedule(w, end, EventClass::protocol, lease_event(i, j));
}

void participant_return(World& w, Id i) {
  Participant& p = w.participants.at(i);
  ++p.lives;
  p.sent_bytes = 0;
  p.async_queue.clear();
  p.run_pending = false;
  for (Id j = 0; j < w.participants.size(); ++j) {
    if (j != i && !w.makes(Mistake::returns_with_memory)) forget(w, j, i);
  }
  for (int s = 0; s < 2; ++s) {
    Writer fresh;
    fresh.budget = sedp(w, i).piggyback_threshold_bytes.count();
    fresh.period = sedp(w, i).heartbeat_period.count();
    if (w.makes(Mistake::returns_with_memory)) fresh.readers = writer(w, i, s).readers;
    if (w.makes(Mistake::returns_with_endpoints)) fresh.existing = writer(w, i, s).existing;
    writer(w, i, s) = fresh;
  }
  schedule(w, w.now, EventClass::protocol, make_event(EventKind::announcement, i, i, 0));
  schedule_creations(w, i, w.now);
}

}  // namespace stormproof::oracle::fastdds
