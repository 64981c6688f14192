// What happens to participants in the oracle of `implementation: cyclone`: leases, outages, deaths
// and successors, and the samples of liveliness that go on (specs/guide/cyclone-life.md). Nobody
// says goodbye here, endpoints stay, and there are no peers.
#include <algorithm>

#include "tests/oracle/cyclone_world.hpp"

namespace stormproof::oracle::cyclone {

namespace {

constexpr Time second = 1'000'000'000;

Time own_lease(const World& w) {
  if (w.scenario.deployment.life->lease) return w.scenario.deployment.life->lease->count();
  return w.spdp.lease ? w.spdp.lease->count() : 10 * second;
}

Time usual_period(Time lease) { return lease < 10 * second ? 4 * lease / 5 : lease - 2 * second; }

bool is_cut(const World& w, Id i, Id j) {
  if (!cross_host(w, i, j)) return false;
  const auto meant = [&](model::Reach reach, Id number, Id k) {
    if (reach == model::Reach::all) return true;
    return number == (reach == model::Reach::host ? w.participants.at(k).host : k);
  };
  for (const model::Outage& o : w.scenario.deployment.life->outages) {
    const bool now = w.now >= o.start.count() && w.now < o.end.count();
    if (now && meant(o.from_reach, o.from, i) && meant(o.to_reach, o.to, j)) return true;
  }
  return false;
}

void check_lease(World& w, Id i, Id j, Time at) {
  Event event;
  event.kind = EventKind::lease;
  event.who = j;
  event.peer = i;
  schedule(w, at, EventClass::protocol, event);
}

// Everything that j knew of i, and what its writers knew of i as their reader.
void forget(World& w, Id i, Id j) {
  w.participants.at(j).known.erase(i);
  for (auto& [key, reader] : w.readers) {
    if (std::get<0>(key) != i || std::get<2>(key) != j) continue;
    const std::size_t timer = reader.timer;
    reader = Reader{};
    reader.timer = timer;
    Timer& acks = w.timers.at(timer);
    acks.due = never;
    acks.listed = false;
    std::erase(w.participants.at(j).due, timer);
  }
  for (auto& [key, writer] : w.writers) {
    if (key.first != j) continue;
    if (writer.readers.erase(i) > 0) ++writer.version;
    std::erase_if(w.delivered, [&](const auto& copy) {
      return std::get<0>(copy) == j && std::get<3>(copy) == i;
    });
  }
  for (Timer& timer : w.timers) {
    if (timer.kind != TimerKind::reply || timer.owner != j || timer.peer != i) continue;
    timer.due = never;
    timer.given_up = true;
  }
}

}  // namespace

Time lease_of(const World& w, Id i) {
  for (const model::Lease& lease : w.scenario.deployment.life->leases) {
    if (lease.participant == i) return lease.duration.count();
  }
  return own_lease(w);
}

Time liveliness_period(const World& w, Id i) { return usual_period(lease_of(w, i)); }

Time announcement_period(const World& w, Id i) {
  if (!w.lives) return w.spdp.period.count();
  const Time profile = w.spdp.lease ? w.spdp.lease->count() : 10 * second;
  if (lease_of(w, i) == profile) return w.spdp.period.count();
  const Time without = std::min(usual_period(profile), 30 * second);
  const Time said = w.spdp.period.count() == without ? 30 * second : w.spdp.period.count();
  return std::min(usual_period(lease_of(w, i)), said);
}

int replies_due(const World& w, Id i) {
  const int all = static_cast<int>(w.spdp.directed_replies);
  if (!w.lives) return all;
  const Time profile = w.spdp.lease ? w.spdp.lease->count() : 10 * second;
  const bool is_said = w.spdp.period.count() != std::min(usual_period(profile), 30 * second);
  const bool hasty = lease_of(w, i) < second || (is_said && w.spdp.period.count() < second);
  return hasty ? std::min(1, all) : all;
}

bool is_dead(const World& w, Id i, Time at) {
  if (!w.lives) return false;
  for (const model::Mute& mute : w.scenario.deployment.life->mute) {
    if (mute.participant == i && at >= mute.from.count()) return true;
  }
  for (const model::Restart& restart : w.scenario.deployment.life->restarts) {
    if (restart.participant == i && at >= restart.stop.count()) return true;
  }
  return false;
}

bool reaches(const World& w, const Packet& packet, Id j) {
  if (!w.lives) return true;
  const bool is_lost = is_cut(w, packet.source, j);
  return !is_dead(w, packet.source, packet.emitted) && !is_dead(w, j, w.now) && !is_lost;
}

void hear(World& w, Id j, Id i) {
  if (!w.lives || !w.participants.at(j).known.contains(i)) return;
  Time& deadline = w.deadlines[{i, j}];
  if (w.now < deadline) deadline = w.now + lease_of(w, i);
}

void begin_lease(World& w, Id j, Id i) {
  if (!w.lives) return;
  w.deadlines[{i, j}] = w.now + lease_of(w, i);
  if (w.leases.insert({i, j}).second) check_lease(w, i, j, w.deadlines.at({i, j}));
}

void lease_event(World& w, Id i, Id j) {
  w.leases.erase({i, j});
  if (!w.participants.at(j).known.contains(i)) return;
  const Time deadline = w.deadlines.at({i, j});
  if (deadline > w.now) {
    w.leases.insert({i, j});
    return check_lease(w, i, j, deadline);
  }
  ++w.outcome.forgotten;
  forget(w, i, j);
}

void say_liveliness(World& w, Id i, std::size_t number) {
  Participant& p = w.participants.at(i);
  Writer& writer = w.writers.at({i, liveliness});
  move(w, number, w.now + liveliness_period(w, i));
  ++writer.history;
  writer.first = writer.history;
  if (writer.readers.empty()) {
    writer.sent = writer.history;
    return;
  }
  writer.n = 0;
  move(w, writer.timer, w.now + w.sedp.heartbeat_interval.count());
  Message data = data_message(w, i, liveliness, writer.history);
  data.to = readers_of(w, i, liveliness);
  p.given.push_back(data);
  if (liveliness_period(w, i) >= 80'000'000) {
    p.given.push_back(heartbeat_to(w, i, liveliness, data.to));
    writer.t_hb = w.now;
    ++writer.n;
  }
  p.given.back().completes = true;
}

// Everybody who is there knows everybody else who is, all that he has, and nobody who is not.
bool is_complete(const World& w) {
  for (Id i = 0; i < w.participants.size(); ++i) {
    for (Id j = 0; j < w.participants.size(); ++j) {
      if (!cross_host(w, i, j) || is_dead(w, j, w.now)) continue;
      const bool knows = w.participants.at(j).known.contains(i);
      if (knows == is_dead(w, i, w.now)) return false;
      if (!knows) continue;
      for (const int s : {publications, subscriptions}) {
        if (w.readers.at({i, s, j}).notified.size() < endpoint_count(w, i, s)) return false;
      }
    }
  }
  return true;
}

void note_completeness(World& w) {
  const bool complete = is_complete(w);
  if (complete && !w.outcome.completed) {
    w.outcome.t_disc_ns = w.now;
    w.until_discovery = w.outcome;
  }
  w.outcome.completed = complete;
}

}  // namespace stormproof::oracle::cyclone
