// The network with `service: unit` (specs/guide/wifi.md): units of frames instead of stages. Also
// senders that stall, with either service.
#include <numeric>

#include "model/engine/network.hpp"

namespace stormproof::model {

Flow Network::flow_of(const InFlight& flight) const {
  const std::uint32_t destination = destination_of(flight.packet).value_or(Flow::everybody);
  if (flight.fragments == 1) return {false, flight.source, destination, flight.packet.port};
  const bool to_all = destination == Flow::everybody;
  return {true, fleet_.host_of(flight.source),
          to_all ? Flow::everybody : fleet_.host_of(destination), 0};
}

void Network::serve_unit(std::uint32_t channel) {
  UnitChannel& units = units_[channel];
  if (units.empty()) return;  // only a mutated table serves nothing
  ChannelState& c = channels_[channel];
  c.unit = units.take(run_.now);
  c.loses_at.clear();
  if (losses_) transmit(c.unit, c.loses_at);
  c.serves = true;
  c.serving_since = run_.now;
  const Nanoseconds until = run_.now + Nanoseconds{c.unit.duration_ns};
  run_.schedule(until, EventKind::service_finished, channel);
  if (run_.probe == nullptr) return;
  run_.probe->waiting_changed(channel, units.size());
  for (const Frame& frame : c.unit.frames) {
    run_.probe->service_started(channel, c.unit.downlink ? 1 : 0, flights_[frame.slot].packet,
                                frame.fragment, until);
  }
}

/// The frames that failed follow at once, as a unit of their own, until none is left or the last
/// transmission has failed, too.
void Network::transmit(Unit& unit, std::vector<std::uint32_t>& loses_at) {
  if (unit.multicast) {
    return lose_multicast(unit.frames.front().slot, unit.access_point, loses_at);
  }
  unit.lost.assign(unit.frames.size(), false);
  unit.duration_ns = 0;
  std::vector<std::size_t> left(unit.frames.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  for (std::uint32_t k = 1; !left.empty() && k <= losses_->most_transmissions(); ++k) {
    std::vector<Frame> frames;
    for (const std::size_t frame : left) frames.push_back(unit.frames[frame]);
    unit.duration_ns += units_.front().duration_ns(frames, unit.rate);
    std::erase_if(left, [&](std::size_t) { return !losses_->fails(unit.host); });
  }
  for (const std::size_t frame : left) unit.lost[frame] = true;
}

/// What follows from a frame is done before that of the next one.
void Network::unit_finished(std::uint32_t channel) {
  ChannelState& c = channels_[channel];
  add_use(c, c.busy, run_.now);
  const Unit unit = std::move(c.unit);
  const std::vector<std::uint32_t> loses_at = std::move(c.loses_at);
  step<fsm::channel::ServiceFinished>(channel);
  for (std::size_t k = 0; k < unit.frames.size(); ++k) {
    const Frame& frame = unit.frames[k];
    const bool lost = !unit.lost.empty() && unit.lost[k];
    if (!unit.downlink) {
      finish_up(frame.slot, frame.fragment, lost);
      continue;
    }
    std::vector<std::uint32_t>& lost_at = flights_[frame.slot].lost_at;
    lost_at.insert(lost_at.end(), loses_at.begin(), loses_at.end());
    if (lost) lost_at.push_back(unit.host);
    finish_down(frame.slot, frame.fragment, unit.access_point);
  }
  step<fsm::channel::EffectsDone>(channel);
}

/// A frame that a station drops goes no further; one that an access point drops is heard by none of
/// its stations. Otherwise it is as if it had been sent.
void Network::settle(std::uint32_t channel, const DroppedFrame& dropped) {
  const Frame& frame = dropped.frame;
  InFlight& flight = flights_[frame.slot];
  const auto traffic = static_cast<std::size_t>(traffic_class(flight.packet));
  const std::uint32_t stage = dropped.access_point ? 1 : 0;
  ++(dropped.access_point ? dropped_.at_access_points : dropped_.at_stations)[traffic];
  if (run_.who_hears(Report::dropped) != nullptr) {
    run_.probe->dropped(channel, stage, flight.packet, frame.fragment);
  }
  if (run_.who_hears(Report::waiting_changed) != nullptr) {
    run_.probe->waiting_changed(channel, units_[channel].size());
  }
  if (!dropped.access_point) return finish_up(frame.slot, frame.fragment, true);
  lose_at_all(flight, *dropped.access_point);
  finish_down(frame.slot, frame.fragment, *dropped.access_point);
}

/// The airtime of the unit up to then, by class: the overhead, what failed and its own airtime to
/// the first frame, to each other one what it adds to that.
void Network::add_use(const ChannelState& c, std::array<Nanoseconds, traffic_class_count>& busy,
                      Nanoseconds until) const {
  const Nanoseconds elapsed = until - c.serving_since;
  std::int64_t bytes = 0;
  for (const Frame& frame : c.unit.frames) bytes += UnitChannel::padded(frame.bytes);
  std::int64_t left = c.unit.duration_ns;
  Nanoseconds begin;
  for (const Frame& frame : c.unit.frames) {
    bytes -= UnitChannel::padded(frame.bytes);
    const bool last = &frame == &c.unit.frames.back();
    const std::int64_t rest = last ? 0 : UnitChannel::airtime_ns(bytes, c.unit.rate);
    const Nanoseconds end = std::min(begin + Nanoseconds{left - rest}, elapsed);
    busy[static_cast<std::size_t>(traffic_class(flights_[frame.slot].packet))] += end - begin;
    begin = end;
    left = rest;
  }
}

void Network::note_stall(std::uint32_t participant) {
  Stall& stall = stalled_[participant];
  const bool stalls_now = sources_[participant].backlog_packets() > 0;
  if (stalls_now && !stall.stalls) stall.since = run_.now;
  if (!stalls_now && stall.stalls) stall.sum += run_.now - stall.since;
  stall.stalls = stalls_now;
  if (!stalls_now) wake(participant);
}

void Network::wake(std::uint32_t participant) {
  for (const Event& event : held_[participant]) run_.schedule_again(event);
  held_[participant].clear();
}

}  // namespace stormproof::model
