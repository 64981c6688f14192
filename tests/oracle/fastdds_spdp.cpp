// SPDP: the announcements of a participant and what another one does when it processes the first of
// them. Unlike in the paper's model the copies to known participants go before the multicast.
#include "tests/oracle/fastdds_world.hpp"

namespace stormproof::oracle::fastdds {

namespace {

std::int64_t spdp_payload(const World& w, Id i) { return has_sizes_of_3(w, i) ? 484 : 252; }

void send_multicast(World& w, Id i) {
  Packet packet;
  packet.kind = PacketKind::spdp;
  packet.source = i;
  packet.payload = spdp_payload(w, i);
  ++w.outcome.spdp_multicast;
  emit(w, packet);
}

void send_copy(World& w, Id i, Id j) {
  Packet packet;
  packet.kind = PacketKind::spdp;
  packet.source = i;
  packet.destination = j;
  packet.payload = spdp_payload(w, i);
  if (cross_host(w, i, j)) ++w.outcome.spdp_unicast;
  emit(w, packet);
}

// To the first ports of every host, whoever has them.
void send_to_ports(World& w, Id i) {
  std::map<std::uint32_t, std::vector<Id>> hosts;
  for (Id j = 0; j < w.participants.size(); ++j) hosts[w.participants.at(j).host].push_back(j);
  for (const auto& [host, there] : hosts) {
    for (std::uint32_t port = 0; port < profile(w, i).peer_ports; ++port) {
      if (port < there.size()) {
        if (there.at(port) != i) send_copy(w, i, there.at(port));
      } else if (host != w.participants.at(i).host) {
        Packet packet;
        packet.kind = PacketKind::spdp;
        packet.source = i;
        packet.destination = there.front();  // for its host
        packet.to_nobody = true;
        packet.payload = spdp_payload(w, i);
        ++w.outcome.spdp_unicast;
        emit(w, packet);
      }
    }
  }
}

void send_to_all(World& w, Id i) {
  if (w.scenario.dds.discovery == model::Discovery::static_peers) {
    send_to_ports(w, i);
  } else {
    send_multicast(w, i);
  }
}

void send_spdp(World& w, Id i) {
  if (w.makes(Mistake::multicast_first)) send_to_all(w, i);
  for (const Id j : w.participants.at(i).known) send_copy(w, i, j);
  if (!w.makes(Mistake::multicast_first)) send_to_all(w, i);
}

void resend(World& w, Id j, Id newcomer) {
  switch (profile(w, j).spdp.resend) {
    case model::SpdpResend::all_known:
      send_spdp(w, j);
      break;
    case model::SpdpResend::new_and_multicast:
      send_copy(w, j, newcomer);
      send_to_all(w, j);
      break;
    case model::SpdpResend::new_only:
      send_copy(w, j, newcomer);
      break;
    case model::SpdpResend::none:
      break;
  }
}

}  // namespace

void open_reader(World& w, Id j, Id i, int s) {
  relation(w, i, j, s).reader_open = true;
  const model::Nanoseconds delay = sedp(w, j).initial_acknack_delay;
  if (delay.count() == 0) return;
  Event event = make_event(EventKind::initial_acknack, j, i, s);
  event.number = delay.count();
  schedule_after(w, delay, event);
}

void announce(World& w, Id i, std::int64_t k) {
  const model::SpdpProfile& spdp = profile(w, i).spdp;
  if (w.server) {
    announce_to_servers(w, i, k);
  } else {
    send_spdp(w, i);
  }
  Event next = make_event(EventKind::announcement, i, i, 0);
  next.number = k + 1;
  const bool startup = k < std::int64_t{spdp.startup_announcements};
  schedule_after(w, startup ? spdp.startup_period : spdp.period, next);
}

void receive_spdp(World& w, Id j, Id i) {
  std::set<Id>& known = w.participants.at(j).known;
  if (known.contains(i)) return;
  get_to_know(w, i, j);
  resend(w, j, i);
  const bool builtin_first =
      profile(w, j).version.match_order == model::MatchOrder::builtin_first &&
      !w.makes(Mistake::endpoints_always_first);
  if (builtin_first) open_builtin(w, i, j);
  for (int s = 0; s < 2; ++s) {
    open_reader(w, j, i, s);
    open_writer(w, j, i, s);
  }
  if (!builtin_first) open_builtin(w, i, j);
}

}  // namespace stormproof::oracle::fastdds
