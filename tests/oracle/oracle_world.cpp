// How a world begins, and the questions about it that all parts of the oracle ask: who may talk to
// whom, who has started, which readers a writer has. It exists so that these have one answer each.
#include "tests/oracle/oracle_world.hpp"

#include <stdexcept>

namespace stormproof::oracle {

namespace {

void create_relations(World& w) {
  const Id n = w.scenario.deployment.size();
  for (Id i = 0; i < n; ++i) {
    for (Id j = 0; j < n; ++j) {
      if (!cross_host(w, i, j)) continue;
      for (int s = 0; s < 2; ++s) {
        const Id count = descriptor_count(w.scenario, i, s);
        Relation r;
        r.state.assign(count, DescriptorState::unsent);
        r.generated.assign(count, false);
        r.received.assign(count, false);
        r.known = count_at_start(w.scenario, i, s);
        w.relations[{i, j, s}] = r;
        if (is_asked_for(w, i, j)) w.missing += count;
      }
    }
  }
}

}  // namespace

World::World(const model::Scenario& s, Mistake m) : scenario{s}, sedp{s.dds.sedp}, mistake{m} {
  for (const model::Participant& p : s.deployment.participants) {
    Participant participant;
    participant.host = p.host.value;
    participant.start = p.start.count();
    participants.push_back(participant);
  }
  create_relations(*this);
  if (relations.empty()) throw std::invalid_argument{"the deployment has no cross-host pair"};
  for (Id i = 0; i < s.deployment.size(); ++i) {
    for (int stream = 0; stream < 2; ++stream) {
      writers[{i, stream}].budget = sedp.piggyback_threshold_bytes.count();
      writers[{i, stream}].period = sedp.heartbeat_period.count();
      const Id first = makes(Mistake::exists_from_the_start) ? descriptor_count(s, i, stream)
                                                             : count_at_start(s, i, stream);
      writers[{i, stream}].written_at_start = first;
      writers[{i, stream}].written = first;
    }
  }
  for (const model::Stage& stage : s.wireless.stages) channels[stage.channel];
  lost_packets.insert(s.wireless.lost_packets.begin(), s.wireless.lost_packets.end());
}

void schedule(World& w, Time at, EventClass event_class, const Event& event) {
  int rank = static_cast<int>(event_class);
  if (w.makes(Mistake::class_ignored)) rank = 0;
  if (w.makes(Mistake::dispatch_first) && event_class == EventClass::dispatch) rank = -1;
  Event& scheduled = w.queue[{at, rank, w.insertions}];
  scheduled = event;
  scheduled.event_class = event_class;
  scheduled.epoch = epoch_of(w, event);
  ++w.insertions;
}

bool cross_host(const World& w, Id i, Id j) {
  return w.participants.at(i).host != w.participants.at(j).host;
}

bool started(const World& w, Id i) {
  if (w.makes(Mistake::receives_unstarted)) return true;
  return w.now >= w.participants.at(i).start;
}

bool completion_ends(const World& w) { return w.scenario.run_until == model::RunUntil::completion; }

Relation& relation(World& w, Id i, Id j, int s) { return w.relations.at({i, j, s}); }

bool all_acknowledged(World& w, Id i, Id j, int s) {
  const Relation& r = relation(w, i, j, s);
  for (Id d = 0; d < w.writers.at({i, s}).written; ++d) {
    if (r.state.at(d) != DescriptorState::acknowledged) return false;
  }
  return true;
}

std::vector<Id> open_readers(World& w, Id i, int s) {
  std::vector<Id> readers;
  for (Id j = 0; j < w.participants.size(); ++j) {
    if (cross_host(w, i, j) && relation(w, i, j, s).writer_open) readers.push_back(j);
  }
  return readers;
}

std::vector<Id> lacking_readers(World& w, Id i, int s) {
  std::vector<Id> readers;
  for (const Id j : open_readers(w, i, s)) {
    if (!all_acknowledged(w, i, j, s)) readers.push_back(j);
  }
  return readers;
}

}  // namespace stormproof::oracle
