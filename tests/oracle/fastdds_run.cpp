// The main loop: the next event is the least of (time, class, insertion number), and one switch
// says what it does. Also what is scheduled before the run, and the report at its end.
#include <algorithm>

#include "tests/oracle/fastdds_world.hpp"

namespace stormproof::oracle::fastdds {

namespace {

const char* name_of(EventKind kind) {
  switch (kind) {
    case EventKind::service_finished:
      return "service finished";
    case EventKind::reception:
      return "reception";
    case EventKind::announcement:
      return "announcement";
    case EventKind::creation:
      return "creation";
    case EventKind::initial_acknack:
      return "initial ACKNACK";
    case EventKind::acknack_generation:
      return "ACKNACK generation";
    case EventKind::nack_response:
      return "nack response";
    case EventKind::async_run:
      return "async run";
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
    case EventKind::control_initial:
      return "initial control ACKNACK";
    case EventKind::control_reply:
      return "control ACKNACK";
    case EventKind::lookup_expiry:
      return "HEARTBEAT expiry of lookups";
    case EventKind::client_tick:
      return "client sync";
    case EventKind::client_expiry:
      return "HEARTBEAT(p) expiry";
    case EventKind::registration_acknack:
      return "ACKNACK(p) of the server";
    case EventKind::registration_initial:
      return "initial ACKNACK(p) of the server";
    case EventKind::learning_acknack:
      return "ACKNACK to the server";
    case EventKind::learning_initial:
      return "initial ACKNACK to the server";
    case EventKind::routine:
      return "server routine";
    case EventKind::sending:
      return "server sends";
    case EventKind::relay_expiry:
      return "HEARTBEAT expiry of the server";
    case EventKind::relay_response:
      return "nack response of the server";
    case EventKind::relay_suppression_end:
      return "suppression end of the server";
    case EventKind::distribution:
      return "distribution";
    case EventKind::beacon:
      return "beacon";
    case EventKind::thread_free:
      return "thread free";
    case EventKind::lease_check:
      return "lease check";
    case EventKind::participant_return:
      return "return of a participant";
    case EventKind::dispatch:
      return "dispatch";
  }
  return "";
}

/// Endpoints are created in their order, even if a creation that was held meets a later one.
void create_next(World& w, const Event& e) {
  if (w.scenario.wireless.sender == model::Sender::backlog) {
    return create(w, e.from, e.stream, e.descriptor);
  }
  std::vector<std::pair<int, Id>>& left = w.participants.at(e.from).to_create;
  const auto [s, d] = left.front();
  left.erase(left.begin());
  create(w, e.from, s, d);
}

void process(World& w, const Event& e) {
  for (const Id i : {e.from, e.to}) {
    if (w.server && w.is_server(i)) w.serve(i);
  }
  switch (e.kind) {
    case EventKind::service_finished:
      return service_finished(w, e);
    case EventKind::reception:
      if (!hears(w, e.to)) return;
      charge_reception(w, w.packets.at(e.packet));
      return receive(w, w.packets.at(e.packet), e.to);
    case EventKind::announcement:
      return announce(w, e.from, e.number);
    case EventKind::creation:
      return create_next(w, e);
    case EventKind::initial_acknack:
      return initial_acknack(w, e.from, e.to, e.stream, e.number);
    case EventKind::acknack_generation:
      return generate_acknack(w, e.from, e.to, e.stream);
    case EventKind::nack_response:
      return nack_response(w, e.from, e.stream);
    case EventKind::async_run:
      return async_run(w, e.from);
    case EventKind::suppression_end:
      return suppression_end(w, e.from, e.to, e.stream);
    case EventKind::heartbeat_expiry:
      return heartbeat_expiry(w, e.from, e.stream);
    case EventKind::cycle_start:
      return cycle_start(w, e.from, e.stream, e.token);
    case EventKind::cycle_end:
      return cycle_end(w, e.from, e.stream, e.token);
    case EventKind::cycle_batch:
      return cycle_batch(w, e);
    case EventKind::control_initial:
      return control_initial(w, e.from, e.to, e.topic, e.number);
    case EventKind::control_reply:
      return control_reply(w, e.from, e.to, e.topic);
    case EventKind::lookup_expiry:
      return lookup_expiry(w, e.from, e.topic);
    case EventKind::client_tick:
      return client_tick(w, e.from);
    case EventKind::client_expiry:
      return client_expiry(w, e.from);
    case EventKind::registration_acknack:
      return registration_acknack(w, e.to);
    case EventKind::registration_initial:
      return registration_initial(w, e.to, e.number);
    case EventKind::learning_acknack:
      return learning_acknack(w, e.from, e.stream);
    case EventKind::learning_initial:
      return learning_initial(w, e.from, e.stream, e.number);
    case EventKind::routine:
      return routine(w, e.token);
    case EventKind::sending:
      return send_next(w);
    case EventKind::relay_expiry:
      return relay_expiry(w, e.stream);
    case EventKind::relay_response:
      return relay_response(w, e.stream);
    case EventKind::relay_suppression_end:
      return relay_suppression_end(w, e.stream, e.to);
    case EventKind::distribution:
      return distribution(w, e.packet);
    case EventKind::beacon:
      return beacon(w, e.access_point);
    case EventKind::thread_free:
      return thread_free(w, e.from);
    case EventKind::lease_check:
      return lease_check(w, e.from, e.to);
    case EventKind::participant_return:
      return participant_return(w, e.from);
    case EventKind::dispatch:
      return dispatch(w, e.channel);
  }
}

}  // namespace

void schedule_creations(World& w, Id i, Time start) {
  const model::Participant& p = w.scenario.deployment.participants.at(i);
  const Time span = (p.endpoints_done - p.start).count();
  std::vector<std::pair<int, Id>> order = creation_order(w.scenario, i);
  if (w.makes(Mistake::publications_first)) std::sort(order.begin(), order.end());
  w.participants.at(i).to_create = order;
  const auto count = static_cast<std::int64_t>(order.size());
  std::int64_t k = w.makes(Mistake::creation_a_step_early) ? -1 : 0;
  for (const auto& [s, d] : order) {
    Event event = make_event(EventKind::creation, i, i, s);
    event.descriptor = d;
    schedule(w, start + span * (k + 1) / count, EventClass::protocol, event);
    ++k;
  }
}

namespace {

void schedule_beginning(World& w) {
  for (Id i = 0; i < w.scenario.deployment.size(); ++i) {
    const Event announcement = make_event(EventKind::announcement, i, i, 0);
    schedule(w, w.participants.at(i).start, EventClass::protocol, announcement);
    schedule_creations(w, i, w.participants.at(i).start);
  }
}

LogEntry log_entry(const std::tuple<Time, EventClass, std::uint64_t>& key, const Event& event) {
  LogEntry entry;
  entry.time_ns = std::get<0>(key);
  entry.event_class = static_cast<int>(std::get<1>(key));
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
    for (Id d = 0; d < r.received.size(); ++d) {
      const bool is_there =
          with_types(w) ? d < r.handed_over && !r.waiting.contains(d) : bool{r.received.at(d)};
      if (!is_there && is_needed(w, i, j, s, d)) missing.push_back({i, j, model::streams[s], d});
    }
  }
  return missing;
}

/// Of admitted packets, if these count.
void take_counts(World& w) {
  if (w.scenario.wireless.count_at == model::CountAt::generation) return;
  if (w.makes(WifiMistake::counted_at_generation)) return;
  w.outcome.initial_data = w.admitted.initial_data;
  w.outcome.repair_data = w.admitted.repair_data;
  w.outcome.heartbeat = w.admitted.heartbeat;
  w.outcome.acknack = w.admitted.acknack;
  w.outcome.spdp_multicast = w.admitted.spdp_multicast;
  w.outcome.spdp_unicast = w.admitted.spdp_unicast;
  w.outcome.user_control = w.admitted.user_control;
  w.outcome.lookup = w.admitted.lookup;
}

FastddsOutcome run(const model::Scenario& given, const EventLog& log, Mistake mistake,
                   std::uint64_t max_events, WifiMistake of_wifi, ServerMistake of_server) {
  const model::Scenario scenario = with_those_who_come_back_as_others(given);
  World w{scenario, mistake, of_wifi, of_server};
  begin_life(w);
  schedule_beginning(w);
  schedule_returns(w);
  while (!w.queue.empty() && !w.ended) {
    const auto key = w.queue.begin()->first;
    const Event event = w.queue.begin()->second;
    if (std::get<0>(key) > scenario.time_limit.count()) break;
    if (max_events > 0 && w.outcome.events == max_events) break;
    w.queue.erase(w.queue.begin());
    w.now = std::get<0>(key);
    ++w.outcome.events;
    const bool of_protocol = std::get<1>(key) == EventClass::protocol;
    const std::optional<Id> actor = who_acts(w, std::get<1>(key), event);
    if (actor && !begins(w, *actor, std::get<2>(key), std::get<1>(key), event)) continue;
    const bool held = of_protocol && event.kind != EventKind::thread_free && is_held(w, event);
    if (!held) {
      if (actor && of_protocol) w.cost += w.scenario.hosts->timer.count();
      if (log) log(log_entry(key, event));
      if (!is_void(w, std::get<1>(key), event)) process(w, event);
      settle_drops(w);
    }
    if (actor) finish(w, *actor);
    if (scenario.deployment.life) note_completion(w);
  }
  w.outcome.missing = missing_descriptors(w);
  w.outcome.held_in_vain = count_held_in_vain(w);
  take_counts(w);
  return w.outcome;
}

}  // namespace

}  // namespace stormproof::oracle::fastdds

namespace stormproof::oracle {

FastddsOutcome run_fastdds(const model::Scenario& scenario, const EventLog& log,
                           FastddsMistake mistake, std::uint64_t max_events, WifiMistake of_wifi,
                           ServerMistake of_server) {
  return fastdds::run(scenario, log, mistake, max_events, of_wifi, of_server);
}

}  // namespace stormproof::oracle
