// SPDP: the announcements of a participant and what another one does when it processes the first of
// them.
#include "tests/oracle/oracle_world.hpp"

namespace stormproof::oracle {

namespace {

void send_multicast(World& w, Id i) {
  Packet packet;
  packet.kind = PacketKind::spdp;
  packet.source = i;
  packet.payload = w.scenario.dds.spdp.payload_bytes.count();
  ++w.outcome.spdp_multicast;
  emit(w, packet);
}

void send_copy(World& w, Id i, Id j) {
  Packet packet;
  packet.kind = PacketKind::spdp;
  packet.source = i;
  packet.destination = j;
  packet.payload = w.scenario.dds.spdp.payload_bytes.count();
  ++w.outcome.spdp_unicast;
  emit(w, packet);
}

void send_spdp(World& w, Id i) {
  if (!w.makes(Mistake::copies_first)) send_multicast(w, i);
  for (Id j = 0; j < w.participants.size(); ++j) {
    if (cross_host(w, i, j) && w.participants.at(i).known.contains(j)) send_copy(w, i, j);
  }
  if (w.makes(Mistake::copies_first)) send_multicast(w, i);
}

void resend(World& w, Id j, Id newcomer) {
  switch (w.scenario.dds.spdp.resend) {
    case model::SpdpResend::all_known:
      send_spdp(w, j);
      break;
    case model::SpdpResend::new_and_multicast:
      send_multicast(w, j);
      send_copy(w, j, newcomer);
      break;
    case model::SpdpResend::new_only:
      send_copy(w, j, newcomer);
      break;
    case model::SpdpResend::none:
      break;
  }
}

void open_reader(World& w, Id j, Id i, int s) {
  relation(w, i, j, s).reader_open = true;
  const Time delay = w.sedp.initial_acknack_delay.count();
  if (delay <= 0) return;
  Event event;
  event.kind = EventKind::initial_acknack;
  event.from = j;
  event.to = i;
  event.stream = s;
  event.number = delay;
  schedule(w, w.now + delay, EventClass::protocol, event);
}

}  // namespace

void announce(World& w, Id i, std::int64_t k) {
  const model::SpdpProfile& spdp = w.scenario.dds.spdp;
  send_spdp(w, i);
  Event next;
  next.kind = EventKind::announcement;
  next.from = i;
  next.to = i;
  next.number = k + 1;
  std::int64_t startups = spdp.startup_announcements;
  if (w.makes(Mistake::startup_one_more)) ++startups;
  const bool startup = k < startups;
  const Time gap = startup ? spdp.startup_period.count() : spdp.period.count();
  schedule(w, w.now + gap, EventClass::protocol, next);
}

void receive_spdp(World& w, Id j, Id i) {
  std::set<Id>& known = w.participants.at(j).known;
  if (known.contains(i)) return;
  if (!w.makes(Mistake::resend_too_early)) known.insert(i);
  resend(w, j, i);
  known.insert(i);
  for (int s = 0; s < 2; ++s) open_reader(w, j, i, s);
  for (int s = 0; s < 2; ++s) {
    if (w.sedp.relation_opening == model::RelationOpening::receiver) {
      open_writer(w, i, j, s);
    } else {
      open_writer(w, j, i, s);
    }
  }
}

}  // namespace stormproof::oracle
