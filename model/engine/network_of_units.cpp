// The network with `service: unit` (specs/guide/wifi.md): frames instead of stages. Also senders
// that stall, with either service.
#include "model/engine/network.hpp"

namespace stormproof::model {

Flow Network::flow_of(const InFlight& flight) const {
  const auto host = [this](std::uint32_t participant) {
    return run_.scenario.deployment.participants[participant].host.value;
  };
  std::uint32_t destination = Flow::everybody;
  if (!flight.packet.multicast()) {
    const Pair& pair = run_.topology.pair(flight.packet.pair);
    destination = flight.packet.to_writer() ? pair.source : pair.destination;
  }
  if (flight.fragments == 1) return {false, flight.source, destination, flight.packet.port};
  if (destination != Flow::everybody) destination = host(destination);
  return {true, host(flight.source), destination, 0};
}

void Network::request_in_unit(std::uint32_t slot, std::uint32_t fragment, bool downlink) {
  const InFlight& flight = flights_[slot];
  const std::int64_t bytes = fragmentation_.bytes(flight.packet.payload_bytes, fragment);
  const Frame frame{next_request_++, slot, fragment, bytes};
  const Flow flow = flow_of(flight);
  const auto& participants = run_.scenario.deployment.participants;
  if (!downlink) {
    units_->request_uplink(participants[flight.source].host.value, frame, flow);
  } else if (flow.destination == Flow::everybody || flow.by_host) {
    units_->request_downlink(flow.destination, frame, flow);
  } else {
    units_->request_downlink(participants[flow.destination].host.value, frame, flow);
  }
  if (run_.probe != nullptr) run_.probe->waiting_changed(0, units_->size());
  step<fsm::channel::ServiceRequested>(0);
}

void Network::serve_unit() {
  if (units_->empty()) return;  // only a mutated table serves nothing
  ChannelState& c = channels_[0];
  unit_ = units_->take();
  c.serves = true;
  c.serving_since = run_.now;
  const Nanoseconds until = run_.now + Nanoseconds{unit_.duration_ns};
  run_.schedule(until, EventKind::service_finished, 0);
  if (run_.probe == nullptr) return;
  run_.probe->waiting_changed(0, units_->size());
  for (const Frame& frame : unit_.frames) {
    run_.probe->service_started(0, unit_.downlink ? 1 : 0, flights_[frame.slot].packet,
                                frame.fragment, until);
  }
}

/// What follows from a frame is done before that of the next one.
void Network::unit_finished() {
  add_use(channels_[0].busy, run_.now);
  const Unit unit = std::move(unit_);
  step<fsm::channel::ServiceFinished>(0);
  for (const Frame& frame : unit.frames) {
    const bool last = frame.fragment + 1 == flights_[frame.slot].fragments;
    if (!unit.downlink) request_in_unit(frame.slot, frame.fragment, true);
    if (!last) continue;
    if (unit.downlink) {
      arrive(frame.slot);
    } else {
      leave_source(frame.slot);
    }
  }
  step<fsm::channel::EffectsDone>(0);
}

/// The airtime of the unit up to then, by class: the overhead and its own airtime to the first
/// frame, to each other one what it adds to that.
void Network::add_use(std::array<Nanoseconds, traffic_class_count>& busy, Nanoseconds until) const {
  const Nanoseconds elapsed = until - channels_[0].serving_since;
  std::int64_t bytes = 0;
  for (const Frame& frame : unit_.frames) bytes += UnitChannel::padded(frame.bytes);
  std::int64_t left = unit_.duration_ns;
  Nanoseconds begin;
  for (const Frame& frame : unit_.frames) {
    bytes -= UnitChannel::padded(frame.bytes);
    const bool last = &frame == &unit_.frames.back();
    const std::int64_t rest = last ? 0 : units_->airtime_ns(bytes);
    const Nanoseconds end = std::min(begin + Nanoseconds{left - rest}, elapsed);
    busy[static_cast<std::size_t>(traffic_class(flights_[frame.slot].packet))] += end - begin;
    begin = end;
    left = rest;
  }
}

void Network::wake(std::uint32_t participant) {
  for (const Event& event : held_[participant]) run_.schedule_again(event);
  held_[participant].clear();
}

}  // namespace stormproof::model
