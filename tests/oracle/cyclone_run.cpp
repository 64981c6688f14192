// The main loop of the oracle of `implementation: cyclone`: the next event is the least of (time,
// class, insertion number). Also what is scheduled before the run, and how a packet is received.
#include "model/life.hpp"
#include "tests/oracle/cyclone_world.hpp"

namespace stormproof::oracle::cyclone {

namespace {

const char* name_of(EventKind kind) {
  switch (kind) {
    case EventKind::service_finished:
      return "service finished";
    case EventKind::reception:
      return "reception";
    case EventKind::start:
      return "start";
    case EventKind::creation:
      return "creation";
    case EventKind::timer:
      return "timer";
    case EventKind::run:
      return "run of the event thread";
    case EventKind::lease:
      return "lease check";
    case EventKind::death:
      return "death";
    case EventKind::dispatch:
      return "dispatch";
    case EventKind::thread_free:
      return "thread free";
  }
  return "";
}

void receive(World& w, const Event& e) {
  if (!hears(w, e.who)) return;
  const Participant& p = w.participants.at(e.who);
  if (w.now < p.open && !w.makes(Mistake::hears_before_open)) return;
  if (w.now < p.ready && !w.makes(Mistake::always_ready)) {
    schedule(w, p.ready, EventClass::service, e);
    return;
  }
  const Packet packet = w.packets.at(e.packet);
  if (!reaches(w, packet, e.who)) return;
  charge_reception(w, packet);
  hear(w, e.who, packet.source);
  for (const Message& m : packet.messages) {
    switch (m.kind) {
      case MessageKind::spdp:
        receive_spdp(w, e.who, m);
        break;
      case MessageKind::data:
        receive_data(w, e.who, m);
        break;
      case MessageKind::heartbeat:
        receive_heartbeat(w, e.who, m);
        break;
      case MessageKind::gap:
        receive_gap(w, e.who, m);
        break;
      case MessageKind::acknack:
        receive_acknack(w, e.who, m, packet.source);
        break;
    }
    if (w.ended) return;
  }
  let_answer_go(w, e.who);
}

void process(World& w, const Event& e) {
  const bool acts = e.kind == EventKind::start || e.kind == EventKind::creation ||
                    e.kind == EventKind::timer || e.kind == EventKind::run ||
                    e.kind == EventKind::lease;
  if (acts && is_dead(w, e.who, w.now)) return;
  switch (e.kind) {
    case EventKind::service_finished:
      return service_finished(w, e);
    case EventKind::reception:
      return receive(w, e);
    case EventKind::start:
      return start(w, e.who);
    case EventKind::creation:
      return create(w, e.who, e.stream, e.sample);
    case EventKind::timer:
      return timer_event(w, e.timer);
    case EventKind::run:
      return run_thread(w, e.who);
    case EventKind::lease:
      return lease_event(w, e.peer, e.who);
    case EventKind::death:
      return;  // whoever asks knows it by the time
    case EventKind::dispatch:
      return dispatch(w, e.channel);
    case EventKind::thread_free:
      return threads::free_again(w, e.who);
  }
}

void schedule_beginning(World& w) {
  for (Id i = 0; i < w.participants.size(); ++i) {
    Event event;
    event.kind = EventKind::start;
    event.who = i;
    const Time start = w.participants.at(i).start;
    schedule(w, start, EventClass::protocol, event);
    const Time done = w.scenario.deployment.participants.at(i).endpoints_done.count();
    const auto order = creation_order(w, i);
    const auto number = static_cast<std::int64_t>(order.size());
    std::int64_t k = 0;
    event.kind = EventKind::creation;
    for (const auto& [stream, sample] : order) {
      event.stream = stream;
      event.sample = sample;
      ++k;
      schedule(w, start + (done - start) * k / number, EventClass::protocol, event);
    }
    if (!w.lives) continue;
    event.kind = EventKind::death;
    for (const model::Mute& mute : w.scenario.deployment.life->mute) {
      if (mute.participant == i) schedule(w, mute.from.count(), EventClass::protocol, event);
    }
    for (const model::Restart& restart : w.scenario.deployment.life->restarts) {
      if (restart.participant != i) continue;
      schedule(w, restart.stop.count(), EventClass::protocol, event);
    }
  }
}

LogEntry log_entry(const std::tuple<Time, EventClass, std::uint64_t>& key, const Event& event) {
  LogEntry entry;
  entry.time_ns = std::get<0>(key);
  entry.event_class = static_cast<int>(std::get<1>(key));
  entry.insertion = std::get<2>(key);
  entry.kind = name_of(event.kind);
  return entry;
}

std::vector<Missing> missing_descriptors(const World& w) {
  std::vector<Missing> missing;
  for (Id i = 0; i < w.participants.size(); ++i) {
    for (Id j = 0; j < w.participants.size(); ++j) {
      if (i == j || !cross_host(w, i, j)) continue;
      for (int s = publications; s <= subscriptions; ++s) {
        const Reader& r = w.readers.at({i, s, j});
        for (Sample k = 1; k <= endpoint_count(w, i, s); ++k) {
          if (r.received.contains(k)) continue;
          missing.push_back({i, j, model::streams[s], static_cast<std::uint32_t>(k - 1)});
        }
      }
    }
  }
  return missing;
}

CycloneOutcome run(const model::Scenario& scenario, const EventLog& log, Mistake mistake,
                   std::uint64_t max_events) {
  World w{scenario, mistake};
  schedule_beginning(w);
  while (!w.queue.empty() && !w.ended) {
    const auto key = w.queue.begin()->first;
    const Event event = w.queue.begin()->second;
    if (std::get<0>(key) > scenario.time_limit.count()) break;
    if (max_events > 0 && w.outcome.events == max_events) break;
    w.queue.erase(w.queue.begin());
    w.now = std::get<0>(key);
    ++w.outcome.events;
    const std::optional<Id> actor = who_acts(w, event);
    const auto [time, event_class, number] = key;
    if (actor && !threads::begins(w, *actor, number, event_class, event)) continue;
    if (actor && event.kind == EventKind::run) w.cost += scenario.hosts->timer.count();
    if (log) log(log_entry(key, event));
    process(w, event);
    if (actor) finish(w, *actor);
    if (w.lives) note_completeness(w);
  }
  if (w.lives && w.outcome.completed) {
    const std::uint64_t events = w.outcome.events;
    w.outcome = w.until_discovery;
    w.outcome.completed = true;
    w.outcome.events = events;
  }
  w.outcome.missing = missing_descriptors(w);
  return w.outcome;
}

}  // namespace

}  // namespace stormproof::oracle::cyclone

namespace stormproof::oracle {

CycloneOutcome run_cyclone(const model::Scenario& scenario, const EventLog& log,
                           CycloneMistake mistake, std::uint64_t max_events) {
  if (!scenario.deployment.life) return cyclone::run(scenario, log, mistake, max_events);
  model::Scenario living = scenario;
  living.deployment = model::with_successors(scenario.deployment);
  return cyclone::run(living, log, mistake, max_events);
}

}  // namespace stormproof::oracle
