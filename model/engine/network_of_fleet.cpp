// The network over access points (specs/guide/fleet.md): each frame of a station goes up to its
// access point and, from all those that the packet has to leave, down again; wired hosts are on the
// distribution system between them. Also transmissions that fail, and stations that sleep.
#include <algorithm>

#include "model/engine/network.hpp"

namespace stormproof::model {

std::optional<std::uint32_t> Network::destination_of(const Packet& packet) const {
  if (packet.multicast()) return std::nullopt;
  const Pair& pair = run_.topology.pair(packet.pair);
  return packet.to_writer() ? pair.source : pair.destination;
}

/// A cable is faster than any program fills it.
void Network::leave_wired_host(std::uint32_t slot) {
  InFlight& flight = flights_[slot];
  admitted_bytes_ -= flight.demand;
  sources_[flight.source].release(flight.demand);
  flight.uses += run_.schedule(run_.now + run_.scenario.deployment.delay_of_cable(),
                               EventKind::distribution, slot);
  release(slot);
}

void Network::leave_cable(std::uint32_t slot) {
  if (run_.who_hears(Report::source_completed) != nullptr)
    run_.probe->source_completed(flights_[slot].packet);
  implementation_->source_completed(flights_[slot].packet);
  for (std::uint32_t k = 0; k < flights_[slot].fragments; ++k) distribute(slot, k);
  release(slot);
}

void Network::request_up(std::uint32_t slot, std::uint32_t fragment) {
  const InFlight& flight = flights_[slot];
  const std::uint32_t host = fleet_.host_of(flight.source);
  const std::uint32_t access_point = fleet_.access_point_of(host);
  const std::uint32_t radio = fleet_.radio_of(access_point);
  if (!by_unit_) return request_stage(slot, fragment, 0, access_point);
  const std::int64_t bytes = fragmentation_.bytes(flight.packet.payload_bytes, fragment);
  units_[radio].request_uplink(host, {next_request_++, slot, fragment, bytes, run_.now},
                               flow_of(flight));
  unit_requested(radio);
}

void Network::request_down(std::uint32_t slot, std::uint32_t fragment, std::uint32_t access_point) {
  const InFlight& flight = flights_[slot];
  const std::uint32_t radio = fleet_.radio_of(access_point);
  if (!by_unit_) return request_stage(slot, fragment, 1, access_point);
  const auto destination = destination_of(flight.packet);
  const std::uint32_t host = destination ? fleet_.host_of(*destination) : Flow::everybody;
  const std::int64_t bytes = fragmentation_.bytes(flight.packet.payload_bytes, fragment);
  units_[radio].request_downlink(host, {next_request_++, slot, fragment, bytes, run_.now},
                                 flow_of(flight), access_point);
  unit_requested(radio);
}

void Network::request_stage(std::uint32_t slot, std::uint32_t fragment, std::uint32_t stage,
                            std::uint32_t access_point) {
  const std::size_t channels_of_one = channels_.size() / fleet_.radios().size();
  const auto channel = static_cast<std::uint32_t>(fleet_.radio_of(access_point) * channels_of_one +
                                                  stages_[stage].channel);
  WaitingFragments& waiting = channels_[channel].waiting;
  waiting.push(stages_[stage].position, {run_.now, next_request_++, slot, fragment, access_point});
  if (run_.who_hears(Report::waiting_changed) != nullptr)
    run_.probe->waiting_changed(channel, waiting.size());
  step<fsm::channel::ServiceRequested>(channel);
}

void Network::unit_requested(std::uint32_t channel) {
  if (run_.who_hears(Report::waiting_changed) != nullptr)
    run_.probe->waiting_changed(channel, units_[channel].size());
  step<fsm::channel::ServiceRequested>(channel);
}

/// A fragment has reached the distribution system: multicast leaves it at every access point.
void Network::distribute(std::uint32_t slot, std::uint32_t fragment) {
  const bool last = fragment + 1 == flights_[slot].fragments;
  const auto destination = destination_of(flights_[slot].packet);
  const auto send_on = [&](std::uint32_t access_point, Nanoseconds when) {
    ++flights_[slot].uses;
    if (when == run_.now) return request_down(slot, fragment, access_point);
    std::vector<Held>& held = held_frames_[{access_point, when}];
    if (held.empty()) run_.schedule(when, EventKind::beacon, access_point);
    held.push_back({slot, fragment});
  };
  if (!destination) {
    for (std::uint32_t a = 0; a < fleet_.access_point_count(); ++a) {
      send_on(a, fleet_.all_awake(a, run_.now));
    }
    if (last) arrive_on_cable(slot);
    return;
  }
  const std::uint32_t host = fleet_.host_of(*destination);
  if (!fleet_.is_wired(host)) {
    send_on(fleet_.access_point_of(host), fleet_.awake(host, run_.now));
  } else if (last) {
    arrive_on_cable(slot);
  }
}

/// What has waited for this beacon asks for the channel now.
void Network::beacon(std::uint32_t access_point) {
  const auto found = held_frames_.find({access_point, run_.now});
  if (found == held_frames_.end()) return;  // only an event that was scheduled twice
  const std::vector<Held> held = std::move(found->second);
  held_frames_.erase(found);
  for (const auto& [slot, fragment] : held) request_down(slot, fragment, access_point);
}

void Network::frame_finished(std::uint32_t channel) {
  ChannelState& c = channels_[channel];
  const ServiceRequest served = c.serving;
  InFlight& flight = flights_[served.slot];
  c.busy[static_cast<std::size_t>(traffic_class(flight.packet))] += run_.now - c.serving_since;
  const bool up = c.serving_stage == 0;
  const bool lost = c.loses;
  if (!up) {
    flight.lost_at.insert(flight.lost_at.end(), c.loses_at.begin(), c.loses_at.end());
    if (lost) flight.lost_at.push_back(fleet_.host_of(*destination_of(flight.packet)));
  }
  step<fsm::channel::ServiceFinished>(channel);
  if (up) {
    finish_up(served.slot, served.fragment, lost);
  } else {
    finish_down(served.slot, served.fragment, served.from);
  }
  step<fsm::channel::EffectsDone>(channel);
}

/// A frame that failed too often goes no further, and its packet reaches nobody.
void Network::finish_up(std::uint32_t slot, std::uint32_t fragment, bool lost) {
  InFlight& flight = flights_[slot];
  const bool last = fragment + 1 == flight.fragments;
  const bool whole_datagrams = !by_unit_ && wireless_.order == ServiceOrder::datagram_uplink;
  if (lost) flight.lost_on_the_way_up = true;
  for (std::uint32_t k = 0;
       whole_datagrams && last && !flight.lost_on_the_way_up && k < flight.fragments; ++k) {
    distribute(slot, k);
  }
  if (!last && wireless_.fragment_request == FragmentRequest::sequential) {
    request_up(slot, fragment + 1);
  }
  if (!whole_datagrams && !lost) distribute(slot, fragment);
  if (--flights_[slot].at_source > 0) return;
  leave_source(slot);
  release(slot);
}

void Network::finish_down(std::uint32_t slot, std::uint32_t fragment, std::uint32_t access_point) {
  if (fragment + 1 == flights_[slot].fragments) arrive_at(slot, access_point);
  release(slot);
}

/// The last frame has left the access point: its stations receive the packet, if they have heard
/// all of it.
void Network::arrive_at(std::uint32_t slot, std::uint32_t access_point) {
  InFlight& flight = flights_[slot];
  renew_bitmap(flight);
  std::vector<std::uint32_t> there;
  const bool reaches = !flight.lost_on_the_way_up && !is_lost(flight.packet.number);
  for (const std::uint32_t receiver : implementation_->receivers(flight.packet)) {
    const std::uint32_t host = fleet_.host_of(receiver);
    const bool heard = std::ranges::find(flight.lost_at, host) == flight.lost_at.end();
    if (reaches && heard && fleet_.is_station(host, access_point)) there.push_back(receiver);
  }
  const bool lost = there.empty() && (!reaches || !flight.lost_at.empty());
  if (run_.who_hears(Report::arrived) != nullptr) run_.probe->arrived(flight.packet, lost);
  if (!lost) note_latency(flight, run_.now);
  for (const std::uint32_t receiver : there) {
    flight.uses += run_.schedule(run_.now, EventKind::reception, slot, receiver);
  }
}

/// The last fragment is on the distribution system: wired hosts receive the packet.
void Network::arrive_on_cable(std::uint32_t slot) {
  InFlight& flight = flights_[slot];
  const Nanoseconds time = run_.now + run_.scenario.deployment.delay_of_cable();
  std::vector<std::uint32_t> there;
  for (const std::uint32_t receiver : implementation_->receivers(flight.packet)) {
    if (fleet_.is_wired(fleet_.host_of(receiver))) there.push_back(receiver);
  }
  if (there.empty()) return;
  const bool lost = flight.lost_on_the_way_up || is_lost(flight.packet.number);
  if (run_.who_hears(Report::arrived) != nullptr) run_.probe->arrived(flight.packet, lost);
  if (lost) return;
  renew_bitmap(flight);
  note_latency(flight, time);
  for (const std::uint32_t receiver : there) {
    flight.uses += run_.schedule(time, EventKind::reception, slot, receiver);
  }
}

ServiceRate Network::rate_of(const ServiceRequest& request, std::uint32_t stage) const {
  const InFlight& flight = flights_[request.slot];
  const bool multicast = flight.packet.multicast();
  ServiceRate rate = service_rate(wireless_, wireless_.stages[stage], multicast);
  const bool as_multicast =
      multicast && wireless_.stages[stage].multicast_as == MulticastAs::multicast;
  if (as_multicast || (multicast && stage > 0)) return rate;
  const std::uint32_t participant = stage == 0 ? flight.source : *destination_of(flight.packet);
  if (const auto own = fleet_.rate(fleet_.host_of(participant))) {
    rate.bits_per_second = own->count();
  }
  return rate;
}

/// How long the channel is busy with the frame: what failed follows at once.
std::int64_t Network::transmit(ChannelState& c, std::int64_t airtime_ns) {
  c.loses = false;
  c.loses_at.clear();
  if (!losses_) return airtime_ns;
  const InFlight& flight = flights_[c.serving.slot];
  const auto destination = destination_of(flight.packet);
  const bool up = c.serving_stage == 0;
  if (!up && !destination) {
    lose_multicast(c.serving.slot, c.serving.from, c.loses_at);
    return airtime_ns;
  }
  const std::uint32_t host = fleet_.host_of(up ? flight.source : *destination);
  std::uint32_t transmissions = 1;
  while (losses_->fails(host)) {
    c.loses = transmissions == losses_->most_transmissions();
    if (c.loses) break;
    ++transmissions;
  }
  return airtime_ns * transmissions;
}

/// What the access point does not send reaches none of its stations.
void Network::lose_at_all(InFlight& flight, std::uint32_t access_point) {
  const auto destination = destination_of(flight.packet);
  if (destination) return flight.lost_at.push_back(fleet_.host_of(*destination));
  for (std::uint32_t host = 0; host < fleet_.host_count(); ++host) {
    if (fleet_.is_station(host, access_point)) flight.lost_at.push_back(host);
  }
}

/// Nobody acknowledges multicast: each station hears it or not.
void Network::lose_multicast(std::uint32_t slot, std::uint32_t access_point,
                             std::vector<std::uint32_t>& loses_at) {
  const std::uint32_t own = fleet_.host_of(flights_[slot].source);
  for (std::uint32_t host = 0; host < fleet_.host_count(); ++host) {
    if (host == own || !fleet_.is_station(host, access_point)) continue;
    if (losses_->fails(host)) loses_at.push_back(host);
  }
}

}  // namespace stormproof::model
