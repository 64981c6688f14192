// The sending end: opening of relations, periodic HEARTBEATs, what an ACKNACK does to the
// descriptor states, and the repair that follows it.
#include <algorithm>

#include "tests/oracle/oracle_world.hpp"

namespace stormproof::oracle {

namespace {

bool adaptive(const World& w) {
  return w.sedp.heartbeat_policy == model::HeartbeatPolicy::adaptive;
}

void schedule_expiry(World& w, Id i, int s) {
  Event event;
  event.kind = EventKind::heartbeat_expiry;
  event.from = i;
  event.to = i;
  event.stream = s;
  ++w.writers.at({i, s}).pending_expiries;
  schedule(w, w.now + w.sedp.heartbeat_period.count(), EventClass::protocol, event);
}

// Returns whether at least one descriptor went from U to R.
bool apply_bitmap(World& w, Relation& r, const Packet& packet) {
  const std::set<Id>& bitmap = packet.bitmap;
  const Id all = static_cast<Id>(r.state.size());
  const Id known = w.makes(Mistake::acknack_confirms_unknown) ? all : packet.announces;
  const bool prefix = w.sedp.acknowledge == model::Acknowledge::prefix;
  const Id more = w.makes(Mistake::prefix_goes_too_far) ? 2 : 0;
  bool requested = false;
  for (Id d = 0; d < known; ++d) {
    DescriptorState& state = r.state.at(d);
    if (bitmap.contains(d)) {
      if (state != DescriptorState::unsent) continue;
      state = DescriptorState::requested;
      requested = true;
    } else if (w.makes(Mistake::confirms_unsent_only) && state != DescriptorState::unsent) {
      continue;
    } else if (!prefix || bitmap.empty() || d < *bitmap.begin() + more) {
      state = DescriptorState::acknowledged;
    }
  }
  return requested;
}

void arm_at_opening(World& w, Id i, int s) {
  if (adaptive(w)) {
    activate_cycles(w, i, s);
  } else if (measures(w)) {
    begin_measuring(w, i, s);
  } else if (w.writers.at({i, s}).pending_expiries == 0) {
    schedule_expiry(w, i, s);
  }
}

// Only a mistake does this: an expiry that is scheduled stays.
void cancel_expiry(World& w, Id i, int s) {
  w.writers.at({i, s}).pending_expiries = 0;
  std::erase_if(w.queue, [&](const auto& entry) {
    const Event& event = entry.second;
    return event.kind == EventKind::heartbeat_expiry && event.from == i && event.stream == s;
  });
}

// Without amendments all of them are the paper's.
model::Amendments rules(const World& w) {
  return w.scenario.dds.amendments.value_or(model::Amendments{});
}

void unacknowledge(Relation& r) {
  for (DescriptorState& state : r.state) {
    if (state == DescriptorState::acknowledged) state = DescriptorState::unsent;
  }
}

Event relation_event(EventKind kind, Id i, Id j, int s) {
  Event event;
  event.kind = kind;
  event.from = i;
  event.to = j;
  event.stream = s;
  return event;
}

}  // namespace

void open_writer(World& w, Id i, Id j, int s) {
  Relation& r = relation(w, i, j, s);
  if (r.writer_open) return;
  r.writer_open = true;
  if (w.sedp.initial_data == model::InitialData::push) {
    std::vector<Id> all;
    for (Id d = 0; d < w.writers.at({i, s}).written; ++d) all.push_back(d);
    generate_data(w, i, j, s, all, false);
  }
  if (w.makes(Mistake::opening_arms_first)) arm_at_opening(w, i, s);
  generate_heartbeat(w, i, j, s);
  arm_at_opening(w, i, s);
}

// One more, of an endpoint that is created or deleted.
void write_descriptor(World& w, Id i, int s) {
  const Id d = w.writers.at({i, s}).written++;
  const bool pushes =
      w.sedp.initial_data == model::InitialData::push && !w.makes(Mistake::creation_not_pushed);
  for (const Id j : open_readers(w, i, s)) {
    if (pushes) generate_data(w, i, j, s, {d}, false);
  }
  if (!w.makes(Mistake::creation_does_not_arm)) arm_at_opening(w, i, s);
}

void arm_heartbeat(World& w, Id i, int s) {
  if (measures(w)) return begin_measuring(w, i, s);
  const bool single = w.sedp.heartbeat_timer == model::HeartbeatTimerKind::single;
  if (single && w.makes(Mistake::heartbeat_restarted)) cancel_expiry(w, i, s);
  if (single && w.writers.at({i, s}).pending_expiries > 0) return;
  schedule_expiry(w, i, s);
}

void heartbeat_expiry(World& w, const Event& event) {
  const Id i = event.from;
  const int s = event.stream;
  if (measures(w)) return measured_expiry(w, i, s, event.token);
  --w.writers.at({i, s}).pending_expiries;
  std::vector<Id> recipients = lacking_readers(w, i, s);
  if (recipients.empty()) return;
  if (w.sedp.heartbeat_recipients == model::HeartbeatRecipients::matched ||
      w.makes(Mistake::expiry_for_all)) {
    recipients = open_readers(w, i, s);
  }
  for (const Id j : recipients) generate_heartbeat(w, i, j, s);
  arm_heartbeat(w, i, s);
}

void receive_acknack(World& w, const Packet& packet) {
  const Id i = *packet.destination;
  const Id j = packet.source;
  const int s = packet.stream;
  Relation& r = relation(w, i, j, s);
  if (!r.writer_open) return;
  if (r.old_counts > 0) {
    --r.old_counts;
    return;
  }
  if (packet.initial) {
    switch (w.sedp.initial_acknack) {
      case model::InitialAckNackReply::bitmap:
        break;
      case model::InitialAckNackReply::heartbeat:
        if (rules(w).initial_acknack_resets == model::Whether::yes) unacknowledge(r);
        generate_heartbeat(w, i, j, s);
        if (rules(w).initial_acknack_arms == model::Whether::yes) arm_at_opening(w, i, s);
        return;
      case model::InitialAckNackReply::none:
        return;
    }
  }
  if (apply_bitmap(w, r, packet)) {
    const Time delay = w.sedp.nack_response_delay.count();
    schedule(w, w.now + delay, EventClass::protocol,
             relation_event(EventKind::repair_generation, i, j, s));
  }
  const bool has_all = packet.announces >= w.writers.at({i, s}).cycle_announced;
  if (adaptive(w) && packet.bitmap.empty() && has_all) response(w, i, j, s);
  if (measures(w)) answered(w, i, j, s);
}

void generate_repair(World& w, Id i, Id j, int s) {
  Relation& r = relation(w, i, j, s);
  std::vector<Id> repaired;
  for (Id d = 0; d < r.state.size(); ++d) {
    if (r.state.at(d) != DescriptorState::requested) continue;
    r.state.at(d) = DescriptorState::queued;
    repaired.push_back(d);
  }
  generate_data(w, i, j, s, repaired, true);
}

void source_completion(World& w, const Packet& packet) {
  if (!packet.repair) return;
  Relation& r = relation(w, packet.source, *packet.destination, packet.stream);
  for (Id d = 0; d < r.state.size(); ++d) {
    const std::vector<Id>& carried = packet.descriptors;
    const bool left = std::find(carried.begin(), carried.end(), d) != carried.end();
    if (!left && !w.makes(Mistake::repair_not_snapshot)) continue;
    if (r.state.at(d) != DescriptorState::queued) continue;
    r.state.at(d) = DescriptorState::suppressed;
    if (w.makes(Mistake::suppression_ignored)) r.state.at(d) = DescriptorState::unsent;
  }
  const Event end =
      relation_event(EventKind::suppression_end, packet.source, *packet.destination, packet.stream);
  schedule(w, w.now + w.sedp.nack_suppression_duration.count(), EventClass::protocol, end);
}

void suppression_end(World& w, Id i, Id j, int s) {
  bool released = false;
  for (DescriptorState& state : relation(w, i, j, s).state) {
    if (state != DescriptorState::suppressed) continue;
    state = DescriptorState::unsent;
    released = true;
  }
  if (w.makes(Mistake::suppression_does_not_arm)) return;
  if (released && !adaptive(w)) arm_heartbeat(w, i, s);
}

}  // namespace stormproof::oracle
