// Participants that were there before the run, fall silent, are out of reach, are forgotten, or
// come back: everything that `deployment.life` says. An event is of the epoch in which it was
// scheduled: who has been forgotten since, or has come back, has nothing to do with it.
#include "tests/oracle/oracle_lives.hpp"
#include "tests/oracle/oracle_world.hpp"

namespace stormproof::oracle {

namespace {

model::Life life_of(const World& w) { return w.scenario.deployment.life.value_or(model::Life{}); }

// j forgets i: what it had of i, and what it knew of i as its reader.
void forget(World& w, Id i, Id j) {
  w.participants.at(j).known.erase(i);
  w.participants.at(j).forgets.erase(i);
  ++w.lease_epochs[{i, j}];
  for (int s = 0; s < 2; ++s) {
    Relation& in = relation(w, i, j, s);
    in.reader_open = false;
    in.heartbeat_seen = false;
    for (std::size_t d = 0; d < in.received.size(); ++d) {
      if (!in.received.at(d) || !is_asked_for(w, i, j)) continue;
      ++w.missing;
      w.outcome.completed = false;
      w.outcome.t_disc_ns = -1;
    }
    in.received.assign(in.received.size(), false);
    if (!w.makes(Mistake::numbers_not_forgotten)) in.known = count_at_start(w.scenario, i, s);
    ++in.reader_epoch;

    if (w.makes(Mistake::forgets_reader_only)) continue;
    Relation& out = relation(w, j, i, s);
    out.writer_open = false;
    out.state.assign(out.state.size(), DescriptorState::unsent);
    out.generated.assign(out.generated.size(), false);
    out.old_counts = 0;
    ++out.writer_epoch;
    w.writers.at({j, s}).cycle_readers.erase(i);
    w.writers.at({j, s}).responded.erase(i);
  }
}

// Before the run i has all of j and takes j for up to date; j knows nothing of i.
void open_before(World& w, Id i, Id j) {
  w.participants.at(i).known.insert(j);
  heard(w, i, j);
  for (int s = 0; s < 2; ++s) {
    Relation& out = relation(w, i, j, s);
    out.writer_open = true;
    for (Id d = 0; d < count_at_start(w.scenario, i, s); ++d) {
      out.state.at(d) = DescriptorState::acknowledged;
    }
    out.old_counts = w.scenario.dds.amendments->count_filter;
    Relation& in = relation(w, j, i, s);
    in.reader_open = true;
    in.heartbeat_seen = true;
    for (Id d = 0; d < count_at_start(w.scenario, j, s); ++d) {
      if (!in.received.at(d) && is_asked_for(w, j, i)) --w.missing;
      in.received.at(d) = true;
    }
  }
}

}  // namespace

model::Scenario with_those_who_come_back_as_others(model::Scenario scenario) {
  if (!scenario.deployment.life) return scenario;
  model::Life& life = *scenario.deployment.life;
  for (const model::Restart& back : life.restarts) {
    if (back.identity == model::Identity::same) continue;
    const Id other = scenario.deployment.size();
    scenario.deployment.participants.push_back(scenario.deployment.participants[back.participant]);
    model::Participant& there = scenario.deployment.participants.back();
    there.endpoints_done = back.start + (there.endpoints_done - there.start);
    if (there.ready) *there.ready += back.start - there.start;
    there.start = back.start;
    for (std::size_t k = 0; k < life.leases.size(); ++k) {
      if (life.leases[k].participant != back.participant) continue;
      life.leases.push_back({other, life.leases[k].duration});
      break;
    }
  }
  return scenario;
}

void begin_life(World& w) {
  if (!w.scenario.deployment.life) return;
  if (!w.makes(Mistake::ends_before_settled)) w.settled = settled(w.scenario);
  for (const model::StaleRelation& stale : life_of(w).stale) {
    open_before(w, stale.writer, stale.reader);
  }
  if (w.missing > 0) return;
  w.outcome.completed = true;
  w.outcome.t_disc_ns = 0;
  w.ended = completion_ends(w) && w.settled == 0;
}

bool is_away(const World& w, Id i, Time at) { return oracle::is_away(w.scenario, i, at); }

bool is_asked_for(const World& w, Id i, Id j) {
  return !is_replaced(w.scenario, i) && !is_replaced(w.scenario, j);
}

bool is_heard(const World& w, const Packet& packet, Id j) {
  if (is_away(w, packet.source, packet.emitted) || is_away(w, j, w.now)) return false;
  if (w.scenario.deployment.life && !oracle::is_ready(w.scenario, j, w.now)) return false;
  return !is_cut_off(w.scenario, packet.source, j, w.now) || w.makes(Mistake::hears_in_outages);
}

int epoch_of(World& w, const Event& e) {
  switch (e.kind) {
    case EventKind::announcement:
    case EventKind::heartbeat_expiry:
    case EventKind::cycle_start:
    case EventKind::cycle_end:
    case EventKind::cycle_batch:
      return w.participants.at(e.from).lives;
    case EventKind::initial_acknack:
    case EventKind::acknack_generation:
      return relation(w, e.to, e.from, e.stream).reader_epoch;
    case EventKind::repair_generation:
    case EventKind::suppression_end:
      return relation(w, e.from, e.to, e.stream).writer_epoch;
    case EventKind::lease_check:
      return w.lease_epochs[{e.from, e.to}];
    case EventKind::participant_return:
    case EventKind::endpoint_change:
    case EventKind::service_finished:
    case EventKind::delayed_reception:
    case EventKind::source_completion:
    case EventKind::dispatch:
      return 0;
  }
  return 0;
}

bool is_void(World& w, const Event& e) {
  if (e.epoch != epoch_of(w, e) && !w.makes(Mistake::forgotten_events_happen)) return true;
  switch (e.kind) {
    case EventKind::service_finished:
    case EventKind::delayed_reception:
    case EventKind::source_completion:
    case EventKind::dispatch:
      return false;
    case EventKind::lease_check:
      return is_away(w, e.to, w.now);
    default:
      return is_away(w, e.from, w.now);
  }
}

// Something of i has reached j.
void heard(World& w, Id j, Id i) {
  const Time lease = lease_of(w.scenario, i);
  Participant& p = w.participants.at(j);
  if (lease == 0 || !p.known.contains(i)) return;
  const bool is_checked = p.forgets.contains(i);
  if (is_checked && w.makes(Mistake::lease_not_renewed)) return;
  p.forgets[i] = w.now + lease;
  if (is_checked) return;
  Event check;
  check.kind = EventKind::lease_check;
  check.from = i;
  check.to = j;
  schedule(w, w.now + lease, EventClass::protocol, check);
}

void lease_check(World& w, Id i, Id j) {
  const Time end = w.participants.at(j).forgets.at(i);
  if (w.now >= end) return forget(w, i, j);
  Event check;
  check.kind = EventKind::lease_check;
  check.from = i;
  check.to = j;
  schedule(w, end, EventClass::protocol, check);
}

void change_endpoints(World& w, const model::LateEndpoints& late) {
  for (Id k = 0; k < late.publications; ++k) write_descriptor(w, late.participant, 0);
  for (Id k = 0; k < late.subscriptions; ++k) write_descriptor(w, late.participant, 1);
}

void participant_return(World& w, Id i) {
  Participant& p = w.participants.at(i);
  ++p.lives;
  p.sent_bytes = 0;
  for (Id j = 0; j < w.participants.size(); ++j) {
    if (!cross_host(w, i, j)) continue;
    if (!w.makes(Mistake::returns_with_memory)) forget(w, j, i);
    for (int s = 0; s < 2; ++s) {
      Relation& towards = relation(w, j, i, s);
      if (towards.writer_open && !w.makes(Mistake::old_counts_forgotten))
        towards.old_counts = w.scenario.dds.amendments->count_filter;
    }
  }
  for (int s = 0; s < 2; ++s) {
    Writer fresh;
    fresh.written_at_start = w.writers.at({i, s}).written_at_start;
    fresh.written = w.writers.at({i, s}).written;
    fresh.budget = w.sedp.piggyback_threshold_bytes.count();
    fresh.period = w.sedp.heartbeat_period.count();
    w.writers.at({i, s}) = fresh;
  }
  Event event;
  event.kind = EventKind::announcement;
  event.from = i;
  event.to = i;
  schedule(w, w.now, EventClass::protocol, event);
}

}  // namespace stormproof::oracle
