// The main loop: the next event is the least of (time, class, insertion number), and one switch
// says what it does. Also the report at the end of a run.
#include "tests/oracle/oracle_world.hpp"

namespace stormproof::oracle {

namespace {

const char* name_of(EventKind kind) {
  switch (kind) {
    case EventKind::service_finished:
      return "service finished";
    case EventKind::delayed_reception:
      return "reception";
    case EventKind::announcement:
      return "announcement";
    case EventKind::initial_acknack:
      return "initial ACKNACK";
    case EventKind::acknack_generation:
      return "ACKNACK generation";
    case EventKind::repair_generation:
      return "repair DATA generation";
    case EventKind::source_completion:
      return "source completion";
    case EventKind::suppression_end:
      return "suppression end";
    case EventKind::heartbeat_expiry:
      return "HEARTBEAT expiry";
    case EventKind::cycle_start:
      return "cycle start";
    case EventKind::cycle_end:
      return "cycle end";
    case EventKind::cycle_batch:
      return "batch";
    case EventKind::lease_check:
      return "lease check";
    case EventKind::participant_return:
      return "return of a participant";
    case EventKind::endpoint_change:
      return "endpoint creation";
    case EventKind::dispatch:
      return "dispatch";
  }
  return "";
}

void process(World& w, const Event& e) {
  if (is_void(w, e)) return;
  switch (e.kind) {
    case EventKind::service_finished:
      return service_finished(w, e);
    case EventKind::delayed_reception:
      if (!w.packets.at(e.packet).lost) receive(w, w.packets.at(e.packet));
      return;
    case EventKind::announcement:
      return announce(w, e.from, e.number);
    case EventKind::initial_acknack:
      return initial_acknack(w, e.from, e.to, e.stream, e.number);
    case EventKind::acknack_generation:
      return generate_acknack(w, e.from, e.to, e.stream);
    case EventKind::repair_generation:
      return generate_repair(w, e.from, e.to, e.stream);
    case EventKind::source_completion:
      return source_completion(w, w.packets.at(e.packet));
    case EventKind::suppression_end:
      return suppression_end(w, e.from, e.to, e.stream);
    case EventKind::heartbeat_expiry:
      return heartbeat_expiry(w, e);
    case EventKind::cycle_start:
      return cycle_start(w, e.from, e.stream, e.token);
    case EventKind::cycle_end:
      return cycle_end(w, e.from, e.stream, e.token);
    case EventKind::cycle_batch:
      return cycle_batch(w, e);
    case EventKind::lease_check:
      return lease_check(w, e.from, e.to);
    case EventKind::participant_return:
      return participant_return(w, e.from);
    case EventKind::endpoint_change:
      return change_endpoints(
          w, w.scenario.deployment.life->endpoints.at(static_cast<std::size_t>(e.number)));
    case EventKind::dispatch:
      return dispatch(w, e.channel);
  }
}

void schedule_first_announcements(World& w) {
  for (Id i = 0; i < w.participants.size(); ++i) {
    Event event;
    event.kind = EventKind::announcement;
    event.from = i;
    event.to = i;
    schedule(w, w.participants.at(i).start, EventClass::protocol, event);
  }
  if (!w.scenario.deployment.life) return;
  for (const model::Restart& back : w.scenario.deployment.life->restarts) {
    if (back.identity == model::Identity::fresh) continue;
    Event event;
    event.kind = EventKind::participant_return;
    event.from = back.participant;
    event.to = back.participant;
    schedule(w, back.start.count(), EventClass::protocol, event);
  }
  std::int64_t k = 0;
  for (const model::LateEndpoints& late : w.scenario.deployment.life->endpoints) {
    Event event;
    event.kind = EventKind::endpoint_change;
    event.from = late.participant;
    event.to = late.participant;
    event.number = k++;
    if (w.makes(Mistake::exists_from_the_start)) continue;
    schedule(w, late.at.count(), EventClass::protocol, event);
    if (!late.until || w.makes(Mistake::deletion_writes_nothing)) continue;
    schedule(w, late.until->count(), EventClass::protocol, event);
  }
}

LogEntry log_entry(const std::tuple<Time, int, std::uint64_t>& key, const Event& event) {
  LogEntry entry;
  entry.time_ns = std::get<0>(key);
  entry.event_class = static_cast<int>(event.event_class);
  entry.insertion = std::get<2>(key);
  entry.kind = name_of(event.kind);
  if (event.kind != EventKind::dispatch) {
    entry.source = event.from;
    entry.destination = event.to;
    entry.stream = event.stream;
  }
  return entry;
}

std::vector<Missing> missing_descriptors(const World& w) {
  std::vector<Missing> missing;
  for (const auto& [key, r] : w.relations) {
    const auto& [i, j, s] = key;
    if (!is_asked_for(w, i, j)) continue;
    for (Id d = 0; d < r.received.size(); ++d) {
      if (!r.received.at(d)) missing.push_back({i, j, model::streams[s], d});
    }
  }
  return missing;
}

}  // namespace

Outcome run(const model::Scenario& given, const EventLog& log, Mistake mistake,
            std::uint64_t max_events) {
  const model::Scenario scenario = with_those_who_come_back_as_others(given);
  World w{scenario, mistake};
  begin_life(w);
  schedule_first_announcements(w);
  while (!w.queue.empty() && !w.ended) {
    const auto key = w.queue.begin()->first;
    const Event event = w.queue.begin()->second;
    if (std::get<0>(key) > scenario.time_limit.count()) break;
    if (max_events > 0 && w.outcome.events == max_events) break;
    w.queue.erase(w.queue.begin());
    w.now = std::get<0>(key);
    ++w.outcome.events;
    if (log) log(log_entry(key, event));
    process(w, event);
    w.ended = w.missing == 0 && w.now >= w.settled && completion_ends(w);
  }
  w.outcome.missing = missing_descriptors(w);
  return w.outcome;
}

}  // namespace stormproof::oracle
