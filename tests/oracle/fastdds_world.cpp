// How a world of the oracle of `implementation: fastdds` begins, and the questions about it that
// all its parts ask. It exists so that these have one answer each.
#include "tests/oracle/fastdds_world.hpp"

#include <stdexcept>

namespace stormproof::oracle::fastdds {

namespace {

void create_relations(World& w) {
  const auto n = static_cast<Id>(w.participants.size());
  for (Id i = 0; i < n; ++i) {
    for (Id j = 0; j < n; ++j) {
      if (i == j) continue;
      for (int s = 0; s < 2; ++s) {
        const Id count = descriptor_count(w.scenario, i, s);
        Relation r;
        r.state.assign(count, DescriptorState::unsent);
        r.delivered.assign(count, false);
        r.received.assign(count, false);
        w.relations[{i, j, s}] = r;
        for (Id d = 0; d < count; ++d) w.missing += is_needed(w, i, j, s, d) ? 1 : 0;
      }
    }
  }
}

}  // namespace

World::World(const model::Scenario& s, FastddsMistake m, WifiMistake of_wifi,
             ServerMistake of_server)
    : scenario{s}, sedp{s.dds.sedp}, mistake{m}, wifi_mistake{of_wifi}, server_mistake{of_server} {
  for (const model::Participant& p : s.deployment.participants) {
    if (p.endpoints_done < p.start) throw std::invalid_argument{"done before the start"};
    Participant participant;
    participant.host = p.host.value;
    participant.start = p.start.count();
    participants.push_back(participant);
  }
  threads::draw_deafness(*this, [](const Participant& p) { return p.start; });
  if (s.deployment.host_count() < 2) throw std::invalid_argument{"no cross-host pair"};
  const model::Discovery discovery = s.dds.discovery;
  if (discovery == model::Discovery::server || discovery == model::Discovery::super_client) {
    const auto& listed = s.deployment.servers;
    for (std::size_t k = 0; k < std::max<std::size_t>(1, listed.size()); ++k) {
      const auto id = static_cast<Id>(participants.size());
      participants.emplace_back();  // from time 0 on
      if (!listed.empty()) participants.back().host = listed[k].host.value;
      Relay& announcements = servers[id].relays[2];
      announcements.history[announcements.next++] = {id, 2, 0};
    }
    serve(s.deployment.size());
  }
  create_relations(*this);
  for (Id i = 0; i < participants.size(); ++i) {
    for (const int stream : {pub, sub, questions, answers}) {
      writers[{i, stream}].budget = profile(*this, i).sedp.piggyback_threshold_bytes.count();
      writers[{i, stream}].period = profile(*this, i).sedp.heartbeat_period.count();
    }
  }
  if (s.wireless.loss) random.seed(s.wireless.loss->seed);
  lost_packets.insert(s.wireless.lost_packets.begin(), s.wireless.lost_packets.end());
}

Event make_event(EventKind kind, Id from, Id to, int s) {
  Event event;
  event.kind = kind;
  event.from = from;
  event.to = to;
  event.stream = s;
  return event;
}

void schedule(World& w, Time at, EventClass event_class, const Event& event) {
  Event& scheduled = w.queue[{at, event_class, w.insertions}];
  scheduled = event;
  if (event_class == EventClass::protocol) scheduled.epoch = epoch_of(w, event);
  ++w.insertions;
}

void schedule_after(World& w, model::Nanoseconds delay, const Event& event) {
  schedule(w, w.now + delay.count(), EventClass::protocol, event);
}

bool cross_host(const World& w, Id i, Id j) {
  return w.participants.at(i).host != w.participants.at(j).host;
}

bool started(const World& w, Id i) { return w.now >= w.participants.at(i).start; }

bool adaptive(const World& w, Id i) {
  return sedp(w, i).heartbeat_policy == model::HeartbeatPolicy::adaptive;
}

const model::DdsProfile& profile(const World& w, Id i) {
  const auto& all = w.scenario.deployment.participants;
  return i < all.size() && all[i].dds ? *all[i].dds : w.scenario.dds;
}

Relation& relation(World& w, Id i, Id j, int s) { return w.relations.at({i, j, s}); }

Writer& writer(World& w, Id i, int s) { return w.writers.at({i, s}); }

}  // namespace stormproof::oracle::fastdds
