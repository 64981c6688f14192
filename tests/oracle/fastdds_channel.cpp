// The way of a packet from its emission to its receptions: over the loopback to participants on the
// same host, and over its source's queue and the stages of the route to the others: those of
// staged_channel.hpp, or with access points and losses as here. Nothing here looks at what is in a
// packet.
#include <algorithm>

#include "tests/oracle/fastdds_world.hpp"
#include "tests/oracle/oracle_sizes.hpp"

namespace stormproof::oracle::fastdds {

namespace {

bool by_unit(const World& w) { return w.scenario.wireless.service == model::ServedBy::unit; }

void enter(World& w, const Packet& head) {
  count_admitted(w, head);
  if (w.makes(WifiMistake::held_until_next_packet)) wake(w, head.source);
  if (is_wired(w, w.participants.at(head.source).host)) return leave_wired_host(w, head);
  if (!over_access_points(w)) return staged::begin(w, head);
  const bool one = w.scenario.wireless.fragment_request == model::FragmentRequest::sequential;
  const Packet whole = head;
  for (std::size_t k = 0; k < (one ? 1 : whole.fragments.size()); ++k) request_up(w, whole, k);
}

void admit(World& w, Id i) {
  if (staged::admit(w, i, [&](const Packet& head) { enter(w, head); })) wake(w, i);
}

// Who is to receive the packet over the loopback (same_host) or over the channel, ascending.
std::vector<Id> receivers(const World& w, const Packet& packet, bool same_host) {
  std::vector<Id> result;
  if (packet.to_nobody) return result;
  for (Id j = 0; j < w.participants.size(); ++j) {
    if (j == packet.source || packet.destination.value_or(j) != j) continue;
    if (cross_host(w, packet.source, j) != same_host) result.push_back(j);
  }
  return result;
}

void schedule_receptions(World& w, const Packet& packet, bool same_host, Time at) {
  std::vector<Id> ids = receivers(w, packet, same_host);
  if (w.makes(Mistake::receptions_reversed)) std::reverse(ids.begin(), ids.end());
  for (const Id j : ids) {
    Event event = make_event(EventKind::reception, packet.source, j, packet.stream);
    event.packet = packet.id;
    schedule(w, at, EventClass::service, event);
  }
}

}  // namespace

void request_frame(World& w, const Packet& packet, std::size_t fragment, std::size_t stage,
                   const std::string& access_point) {
  if (by_unit(w)) return request_unit(w, packet, fragment, stage > 0, access_point);
  staged::enqueue(w, radio_of(w, access_point) + "/" + w.scenario.wireless.stages.at(stage).channel,
                  {packet.id, stage, fragment, access_point});
}

void request(World& w, std::uint64_t packet, std::size_t fragment, std::size_t stage) {
  request_frame(w, w.packets.at(packet), fragment, stage, access_points(w).front());
}

void request_up(World& w, const Packet& packet, std::size_t fragment) {
  const Id host = w.participants.at(packet.source).host;
  request_frame(w, packet, fragment, 0, access_point_of(w, host));
}

void leave_wired_host(World& w, const Packet& packet) {
  w.participants.at(packet.source).queued_bytes -= staged::demand(w, packet);
  Event event;
  event.kind = EventKind::distribution;
  event.packet = packet.id;
  event.from = packet.source;
  schedule(w, w.now + w.scenario.deployment.delay_of_cable().count(), EventClass::service, event);
}

void leave_source(World& w, const Packet& packet) {
  w.participants.at(packet.source).queued_bytes -= staged::demand(w, packet);
  admit(w, packet.source);
}

void arrive(World& w, const Packet& packet) {
  if (!packet.lost) schedule_receptions(w, packet, false, w.now);
}

namespace {
void receive_at(World& w, const Packet& packet, Id j, Time at) {
  Event event = make_event(EventKind::reception, packet.source, j, packet.stream);
  event.packet = packet.id;
  schedule(w, at, EventClass::service, event);
}
}  // namespace

void arrive_at(World& w, const Packet& packet, const std::string& access_point) {
  if (packet.lost || packet.stopped) return;
  for (const Id j : receivers(w, packet, false)) {
    const Id host = w.participants.at(j).host;
    if (!is_station(w, host, access_point)) continue;
    if (packet.deaf.contains(host) && !w.makes(WifiMistake::losses_received)) continue;
    receive_at(w, packet, j, w.now);
  }
}

void arrive_on_cable(World& w, const Packet& packet) {
  if (packet.lost || packet.stopped) return;
  const Time cable = w.scenario.deployment.delay_of_cable().count();
  for (const Id j : receivers(w, packet, false)) {
    const bool on_cable = is_wired(w, w.participants.at(j).host);
    if (on_cable) receive_at(w, packet, j, w.now + cable);
  }
}

void emit(World& w, Packet packet) {
  packet.id = w.packets.size();
  packet.payload += profile(w, packet.source).version.statistics_bytes.count();
  packet.emitted = w.now;
  packet.fragments = cut_into_fragments(w.scenario.wireless, packet.payload);
  const bool on_channel = packet.to_nobody || !receivers(w, packet, false).empty();
  const std::uint64_t number = w.outcome.packets;
  if (on_channel) packet.lost = w.lost_packets.contains(number);
  if (on_channel || w.makes(Mistake::loopback_takes_a_number)) ++w.outcome.packets;
  w.packets[packet.id] = packet;
  charge_sending(w, packet);

  const Time loopback =
      w.makes(Mistake::loopback_without_delay) ? 0 : w.scenario.deployment.loopback_delay.count();
  schedule_receptions(w, packet, true, w.now + loopback);
  if (!on_channel) return;
  if (w.scenario.wireless.kind == model::ServiceKind::constant_delay) {
    Time one_way = w.scenario.wireless.one_way.count();
    for (const model::PacketDelay& delay : w.scenario.wireless.packet_delays) {
      if (delay.packet == number) one_way = delay.one_way.count();
    }
    count_admitted(w, packet);
    if (!packet.lost) schedule_receptions(w, packet, false, w.now + one_way);
    return;
  }
  w.participants.at(packet.source).backlog.push_back(packet.id);
  admit(w, packet.source);
}

void dispatch(World& w, const std::string& name) {
  if (by_unit(w)) return dispatch_unit(w, name);
  const std::optional<Request> taken = staged::take_next(w, name);
  if (!taken) return;
  const Request& next = *taken;

  const Packet& packet = w.packets.at(next.packet);
  const bool multicast = !packet.destination.has_value();
  Event event = staged::end_of(w, next, name);
  event.access_point = next.access_point;
  const std::int64_t bytes = packet.fragments.at(next.fragment);
  model::WirelessProfile own = w.scenario.wireless;
  const bool acknowledged = next.stage == 0 || !multicast;
  const Id station = w.participants.at(next.stage == 0 ? packet.source : event.to).host;
  if (acknowledged && over_access_points(w)) {
    own.stages.at(next.stage).rate_unicast = model::BitsPerSecond{rate_of(
        w, station, own.stages.at(next.stage).rate_unicast.value_or(own.rate_unicast).count())};
  }
  const Time once = airtime(own, next.stage, multicast, bytes);
  Time duration = once;
  if (own.loss && !acknowledged) event.deaf = deaf_to_multicast(w, packet, next.access_point);
  if (own.loss && acknowledged) {
    std::uint32_t failed = 0;
    while (failed <= own.loss->retries && transmission_fails(w, station)) ++failed;
    event.fails = failed > own.loss->retries;
    const std::uint32_t sent = event.fails ? failed : failed + 1;
    if (!w.makes(WifiMistake::retries_free)) duration = once * sent;
    if (event.fails && next.stage == 1) event.deaf.push_back(station);
  }
  schedule(w, w.now + duration, EventClass::service, event);
}

namespace {

void frame_finished(World& w, const Event& event) {
  const model::WirelessProfile& wireless = w.scenario.wireless;
  const Packet packet = w.packets.at(event.packet);
  const bool last = event.fragment + 1 == packet.fragments.size();
  if (event.stage == 1) {
    w.packets.at(packet.id).deaf.insert(event.deaf.begin(), event.deaf.end());
    if (last) arrive_at(w, w.packets.at(packet.id), event.access_point);
    return;
  }
  if (event.fails && !w.makes(WifiMistake::losses_received)) w.packets.at(packet.id).stopped = true;
  const bool goes_on = !event.fails || w.makes(WifiMistake::losses_received);
  const bool whole_datagrams = wireless.order == model::ServiceOrder::datagram_uplink;
  if (whole_datagrams && last && !w.packets.at(packet.id).stopped) {
    for (std::size_t k = 0; k < packet.fragments.size(); ++k) distribute(w, packet.id, k);
  }
  if (!last && wireless.fragment_request == model::FragmentRequest::sequential) {
    request_up(w, packet, event.fragment + 1);
  }
  if (!whole_datagrams && goes_on) distribute(w, packet.id, event.fragment);
  if (last) leave_source(w, packet);
}

}  // namespace

void service_finished(World& w, const Event& event) {
  if (by_unit(w)) return unit_finished(w, event.channel);
  if (!over_access_points(w)) return staged::service_finished(w, event);
  w.channels.at(event.channel).busy = false;
  frame_finished(w, event);
  if (!w.channels.at(event.channel).waiting.empty()) staged::schedule_dispatch(w, event.channel);
}

}  // namespace stormproof::oracle::fastdds
