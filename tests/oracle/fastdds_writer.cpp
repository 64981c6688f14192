// A built-in writer without its DATA: opening of relations, periodic HEARTBEATs, what an ACKNACK
// does to the descriptor states, and how requested descriptors get into the async queue.
#include <algorithm>

#include "tests/oracle/fastdds_world.hpp"

namespace stormproof::oracle::fastdds {

namespace {

// A HEARTBEAT of its own to j alone.
void heartbeat_to(World& w, Id i, Id j, int s) { heartbeat(w, i, j, s, heartbeat_payload); }

bool needs_heartbeat(World& w, Id i, Id j, int s) {
  const Relation& r = relation(w, i, j, s);
  const Id existing = writer(w, i, s).existing;
  if (existing > 0 && r.low == 0) return true;
  for (Id d = 0; d < existing; ++d) {
    if (r.state.at(d) == DescriptorState::unsent) return true;
    const bool acknowledged = r.state.at(d) == DescriptorState::acknowledged;
    if (w.makes(Mistake::expiry_until_acknowledged) && !acknowledged) return true;
  }
  return false;
}

void take_initial_acknack(World& w, Id i, Id j, int s) {
  Relation& r = relation(w, i, j, s);
  for (Id d = 0; d < writer(w, i, s).existing; ++d) {
    DescriptorState& state = r.state.at(d);
    if (d < r.low || state == DescriptorState::acknowledged) state = DescriptorState::unsent;
  }
  if (!w.makes(Mistake::initial_keeps_low)) r.low = 0;
  heartbeat_to(w, i, j, s);
  if (!w.makes(Mistake::initial_does_not_arm)) arm(w, i, s);
}

// Returns whether at least one descriptor went from U to R.
bool take_bitmap(const World& w, Relation& r, const Packet& packet, Id existing) {
  for (Id d = 0; d < std::min(packet.base, existing); ++d) {
    const bool unsent = r.state.at(d) == DescriptorState::unsent;
    if (w.makes(Mistake::base_confirms_unsent_only) && !unsent) continue;
    r.state.at(d) = DescriptorState::acknowledged;
  }
  if (!w.makes(Mistake::low_not_raised)) r.low = std::max(r.low, packet.base);
  bool requested = false;
  for (const Id d : packet.bitmap) {
    if (d >= existing || r.state.at(d) != DescriptorState::unsent) continue;
    r.state.at(d) = DescriptorState::requested;
    requested = true;
  }
  return requested;
}

}  // namespace

void heartbeat(World& w, Id i, Id j, int s, std::int64_t payload) {
  Packet packet;
  packet.kind = PacketKind::sedp;
  packet.source = i;
  packet.destination = j;
  packet.stream = s;
  packet.payload = payload;
  packet.announced = writer(w, i, s).existing;
  packet.heartbeats = 1;
  if (w.makes(Mistake::announces_all)) packet.announced = descriptor_count(w.scenario, i, s);
  if (cross_host(w, i, j)) ++w.outcome.heartbeat;
  emit(w, packet);
  writer(w, i, s).budget = sedp(w, i).piggyback_threshold_bytes.count();
}

void open_writer(World& w, Id i, Id j, int s) {
  relation(w, i, j, s).writer_open = true;
  writer(w, i, s).readers.push_back(j);
  if (writer(w, i, s).existing > 0) arm(w, i, s);
  heartbeat_to(w, i, j, s);
}

void arm(World& w, Id i, int s) {
  if (adaptive(w, i)) {
    activate_cycles(w, i, s);
    return;
  }
  Writer& wr = writer(w, i, s);
  if (wr.expiry_pending) return;
  wr.expiry_pending = true;
  schedule_after(w, sedp(w, i).heartbeat_period, make_event(EventKind::heartbeat_expiry, i, i, s));
}

void heartbeat_expiry(World& w, Id i, int s) {
  Writer& wr = writer(w, i, s);
  wr.expiry_pending = false;
  bool needed = false;
  for (const Id j : wr.readers) needed = needed || needs_heartbeat(w, i, j, s);
  if (!needed) return;
  const bool alone = wr.readers.size() == 1 || w.makes(Mistake::expiry_to_several_larger);
  const std::int64_t payload = alone ? heartbeat_payload : heartbeat_to_several;
  for (const Id j : wr.readers) heartbeat(w, i, j, s, payload);
  arm(w, i, s);
}

void receive_acknack(World& w, const Packet& packet) {
  const Id i = *packet.destination;
  const Id j = packet.source;
  const int s = packet.stream;
  Relation& r = relation(w, i, j, s);
  if (!r.writer_open) return;
  if (packet.initial) {
    take_initial_acknack(w, i, j, s);
    return;
  }
  Writer& wr = writer(w, i, s);
  if (take_bitmap(w, r, packet, wr.existing)) {
    if (!wr.response_pending || w.makes(Mistake::response_per_request)) {
      wr.response_pending = true;
      schedule_after(w, sedp(w, i).nack_response_delay,
                     make_event(EventKind::nack_response, i, i, s));
    }
  } else if (!packet.bitmap.empty() && !w.makes(Mistake::vain_request_does_not_arm)) {
    arm(w, i, s);
  }
  const bool recent = packet.base >= wr.cycle_existing;
  const bool clean = packet.bitmap.empty() && (recent || w.makes(Mistake::response_with_old_base));
  if (adaptive(w, i) && clean) response(w, i, j, s);
}

void nack_response(World& w, Id i, int s) {
  Writer& wr = writer(w, i, s);
  wr.response_pending = false;
  Participant& p = w.participants.at(i);
  for (const Id j : wr.readers) {
    for (Id d = 0; d < wr.existing; ++d) {
      DescriptorState& state = relation(w, i, j, s).state.at(d);
      if (state != DescriptorState::requested) continue;
      state = DescriptorState::queued;
      const std::pair<int, Id> entry{s, d};
      const auto found = std::find(p.async_queue.begin(), p.async_queue.end(), entry);
      if (found == p.async_queue.end()) p.async_queue.push_back(entry);
    }
  }
  const bool pending = p.run_pending && !w.makes(Mistake::run_per_response);
  if (p.async_queue.empty() || pending) return;
  p.run_pending = true;
  schedule(w, w.now, EventClass::protocol, make_event(EventKind::async_run, i, i, s));
}

void suppression_end(World& w, Id i, Id j, int s) {
  Relation& r = relation(w, i, j, s);
  r.suppression_pending = false;
  for (DescriptorState& state : r.state) {
    if (state == DescriptorState::suppressed) state = DescriptorState::unsent;
  }
  if (!w.makes(Mistake::suppression_end_arms_not)) arm(w, i, s);
}

}  // namespace stormproof::oracle::fastdds
