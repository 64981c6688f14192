// Admission, the stages of the route, and what follows from the end of a service.
#include "model/engine/network.hpp"

#include <algorithm>

namespace stormproof::model {

namespace {

int stage_rank(ServiceOrder order, std::size_t stage) {
  switch (order) {
    case ServiceOrder::fifo_uplink:
    case ServiceOrder::datagram_uplink:
      return static_cast<int>(stage);
    case ServiceOrder::fifo_downlink:
      return -static_cast<int>(stage);
    case ServiceOrder::fifo:
      return 0;
  }
  return 0;
}

}  // namespace

Network::Network(RunState& run)
    : run_{run},
      wireless_{run.scenario.wireless},
      fragmentation_{run.scenario.wireless},
      sources_(run.topology.participant_count()),
      fleet_{run.scenario},
      by_unit_{wireless_.service == ServedBy::unit},
      over_access_points_{by_unit_ || fleet_.is_listed() || wireless_.loss},
      some_listen_early_{
          std::ranges::any_of(run.scenario.deployment.participants,
                              [](const Participant& one) { return one.open || one.ready; })},
      drops_frames_{by_unit_ && queues_drop(wireless_)},
      sender_stalls_{wireless_.sender == Sender::stalls},
      counts_at_admission_{wireless_.count_at == CountAt::admission},
      takes_at_admission_{over_access_points_ || counts_at_admission_},
      admits_together_{wireless_.kind == ServiceKind::shared_channel && !takes_at_admission_ &&
                       run.mutation == nullptr && !run.hears_single_packets},
      leaving_(sources_.size()) {
  if (wireless_.kind == ServiceKind::shared_channel) build_route();
  for (std::size_t radio = 0; by_unit_ && radio < fleet_.radios().size(); ++radio) {
    units_.emplace_back(wireless_, fleet_.host_count(), fleet_.access_point_count());
    for (std::uint32_t host = 0; host < fleet_.host_count(); ++host) {
      if (const auto rate = fleet_.rate(host)) units_.back().set_rate(host, *rate);
    }
  }
  if (sender_stalls_) held_.resize(sources_.size());
  if (sender_stalls_) stalled_.resize(sources_.size());
  if (wireless_.loss) losses_.emplace(*wireless_.loss, fleet_.host_count());
  if (run.scenario.hosts) {
    processors_ = std::make_unique<Processors>(run_, *run.scenario.hosts, fleet_);
  }
}

/// One channel for each name on the route; as many for each channel of access points.
void Network::build_route() {
  for (const std::string& radio : fleet_.radios()) {
    const std::size_t first = channels_.size();
    stages_.clear();
    for (std::size_t x = 0; x < wireless_.stages.size(); ++x) {
      const Stage& stage = wireless_.stages[x];
      auto channel =
          std::find_if(channels_.begin() + static_cast<std::ptrdiff_t>(first), channels_.end(),
                       [&](const ChannelState& c) { return c.name == stage.channel; });
      if (channel == channels_.end()) {
        channels_.emplace_back();
        channel = channels_.end() - 1;
        channel->name = stage.channel;
      }
      StageState state;  // numbered within its radio
      state.channel = static_cast<std::uint32_t>(channel - channels_.begin()) -
                      static_cast<std::uint32_t>(first);
      state.position = channel->waiting.add_stage(stage_rank(wireless_.order, x));
      state.rate = {MemoizedRate{service_rate(wireless_, stage, false)},
                    MemoizedRate{service_rate(wireless_, stage, true)}};
      channel->stages.push_back(static_cast<std::uint32_t>(x));
      stages_.push_back(state);
    }
    for (std::size_t k = first; fleet_.radios().size() > 1 && k < channels_.size(); ++k) {
      channels_[k].name = radio + " " + channels_[k].name;
    }
  }
}

void Network::emit(std::uint32_t source, Packet&& packet) {
  packet.number = next_packet_;
  packet.emitted = run_.now;
  next_packet_ += packet.copies;
  if (processors_ != nullptr) processors_->send(packet, packet.copies);
  if (run_.who_hears(Report::emitted) != nullptr) {
    std::vector<std::uint32_t>& destinations = destinations_;
    destinations.clear();
    std::uint32_t pair = packet.pair;
    for (std::uint32_t copy = 0; copy < packet.copies && !packet.multicast() && !packet.to_nobody;
         ++copy) {
      if (copy > 0) pair = implementation_->next_recipient(packet, pair);
      const Pair& ends = run_.topology.pair(pair);
      destinations.push_back(packet.to_writer() ? ends.source : ends.destination);
    }
    run_.probe->emitted(packet, source, destinations);
  }
  if (wireless_.kind == ServiceKind::constant_delay) {
    emit_with_delay(source, std::move(packet));
    return;
  }
  backlog_packets_ += packet.copies;
  sources_[source].push(std::move(packet), fragmentation_);
  admit(source);
}

void Network::admit(std::uint32_t source) {
  SourceQueue& queue = sources_[source];
  const bool at_admission = wireless_.fragment_request == FragmentRequest::at_admission;
  while (const std::uint32_t fitting = queue.fitting(wireless_.source_queue_bytes)) {
    const auto requested =
        at_admission ? static_cast<std::uint32_t>(queue.head_fragments()) : std::uint32_t{1};
    const std::uint32_t packets = admits_together_ && requested == 1 ? fitting : 1;
    backlog_packets_ -= packets;
    admitted_bytes_ += queue.head_demand() * packets;
    queue.admit_head(fragmentation_, packets);
    if (!takes_at_admission_) {
      for (std::uint32_t k = 0; k < requested; ++k) request(on_tape, k, 0, source, packets);
      continue;
    }
    const std::uint32_t slot = take(source, run_.now);
    if (counts_at_admission_) implementation_->count(flights_[slot].packet);
    if (fleet_.is_wired(fleet_.host_of(source))) {
      leave_wired_host(slot);
      continue;
    }
    for (std::uint32_t k = 0; k < requested; ++k) {
      over_access_points_ ? request_up(slot, k) : request(slot, k, 0);
    }
  }
  queue.note_peak(run_.now);
  if (sender_stalls_) note_stall(source);
  if (run_.who_hears(Report::backlog_changed) != nullptr) {
    run_.probe->backlog_changed(source, queue.backlog_packets(), queue.admitted_bytes());
  }
}

/// The next packet of those that the source has admitted, which was at that time, begins to be
/// under way.
std::uint32_t Network::take(std::uint32_t source, Nanoseconds admitted) {
  const std::uint32_t slot = allocate(source);
  InFlight& flight = flights_[slot];
  sources_[source].take(flight.packet, next_recipient());
  const std::int64_t fragments = fragmentation_.count(flight.packet.payload_bytes);
  flight.fragments = static_cast<std::uint32_t>(fragments);
  flight.at_source = flight.fragments;
  flight.demand = fragmentation_.demand(flight.packet.payload_bytes, fragments);
  flight.admitted = admitted;
  return slot;
}

std::uint32_t Network::allocate(std::uint32_t source) {
  const std::uint32_t slot = flights_.take();
  InFlight& flight = flights_[slot];
  flight.fragments = 1;
  flight.source = source;
  flight.uses = 1;
  if (over_access_points_) {
    flight.lost_on_the_way_up = false;
    flight.lost_at.clear();
  }
  return slot;
}

template <class Event>
[[gnu::always_inline]] inline void Network::step(std::uint32_t channel) {
  ChannelState& c = channels_[channel];
  const bool waiting = by_unit_ ? !units_[channel].empty() : !c.waiting.empty();
  const auto output = channel_driver_.step<Event>(
      c.state, {.waiting = waiting, .dispatch_pending = c.dispatch_pending}, channel);
  if (output.schedule_dispatch) {
    c.dispatch_pending = true;
    run_.schedule(run_.now, EventKind::dispatch, channel);
  }
  if (output.serve) serve(channel);
}

template void Network::step<fsm::channel::ServiceRequested>(std::uint32_t);
template void Network::step<fsm::channel::ServiceFinished>(std::uint32_t);
template void Network::step<fsm::channel::EffectsDone>(std::uint32_t);

void Network::request(std::uint32_t slot, std::uint32_t fragment, std::uint32_t stage,
                      std::uint32_t source, std::uint32_t packets) {
  const StageState& target = stages_[stage];
  channels_[target.channel].waiting.push(
      target.position, {run_.now, next_request_, slot, fragment, source, packets});
  next_request_ += packets;
  if (run_.who_hears(Report::waiting_changed) != nullptr) {
    run_.probe->waiting_changed(target.channel, channels_[target.channel].waiting.size());
  }
  step<fsm::channel::ServiceRequested>(target.channel);
}

void Network::serve(std::uint32_t channel) {
  if (by_unit_) return serve_unit(channel);
  ChannelState& c = channels_[channel];
  if (c.waiting.empty()) return;  // only a mutated table serves nothing
  c.serving_stage = c.stages[c.waiting.pop(c.serving)];
  if (c.serving.slot == on_tape) {
    std::uint32_t& slot = leaving_[c.serving.from];
    if (c.serving.fragment == 0) slot = take(c.serving.from, c.serving.time);
    c.serving.slot = slot;
  }
  c.serves = true;
  c.serving_since = run_.now;
  const Packet& packet = flights_[c.serving.slot].packet;
  MemoizedRate& rate = stages_[c.serving_stage].rate[packet.multicast() ? 1 : 0];
  const std::int64_t bytes = fragmentation_.bytes(packet.payload_bytes, c.serving.fragment);
  const std::int64_t duration =
      over_access_points_ ? transmit(c, rate_of(c.serving, c.serving_stage).airtime_ns(bytes))
                          : rate.airtime_ns(bytes);
  const Nanoseconds until = run_.now + Nanoseconds{duration};
  run_.schedule(until, EventKind::service_finished, channel);
  if (run_.who_hears(Report::waiting_changed) != nullptr) {
    run_.probe->waiting_changed(channel, c.waiting.size());
  }
  if (run_.who_hears(Report::service_started) != nullptr) {
    run_.probe->service_started(channel, c.serving_stage, packet, c.serving.fragment, until);
  }
}

void Network::handle(const Event& event) {
  switch (event.kind) {
    case EventKind::service_finished:
      service_finished(event.subject);
      break;
    case EventKind::dispatch:
      channels_[event.subject].dispatch_pending = false;
      step<fsm::channel::DispatchDue>(event.subject);
      break;
    case EventKind::distribution:
      leave_cable(event.subject);
      break;
    case EventKind::beacon:
      beacon(event.subject);
      break;
    case EventKind::source_completion:
      if (run_.who_hears(Report::source_completed) != nullptr)
        run_.probe->source_completed(flights_[event.subject].packet);
      implementation_->source_completed(flights_[event.subject].packet);
      release(event.subject);
      break;
    case EventKind::reception:
      if (processors_ != nullptr && !processors_->hears(event.detail)) {
        release(event.subject);
        break;
      }
      if (some_listen_early_) {
        if (const auto later = implementation_->receives_later(event.detail)) {
          flights_[event.subject].uses +=
              run_.schedule(*later, EventKind::reception, event.subject, event.detail);
          release(event.subject);
          break;
        }
      }
      renew_bitmap(flights_[event.subject]);
      note_journey(flights_[event.subject]);
      if (run_.who_hears(Report::received) != nullptr) {
        run_.probe->received(flights_[event.subject].packet, event.detail);
      }
      if (processors_ != nullptr) processors_->receive(flights_[event.subject].packet);
      hand_over(flights_[event.subject].packet, event.detail);
      release(event.subject);
      break;
    default:
      arrive(event.subject);
      break;
  }
}

void Network::service_finished(std::uint32_t channel) {
  ChannelState& c = channels_[channel];
  if (!c.serves) return;  // only an event that was scheduled twice finds nothing served
  c.serves = false;
  if (by_unit_) return unit_finished(channel);
  if (over_access_points_) return frame_finished(channel);
  const std::uint32_t slot = c.serving.slot;
  const std::uint32_t fragment = c.serving.fragment;
  const std::uint32_t stage = c.serving_stage;
  const InFlight& flight = flights_[slot];
  const bool last = fragment + 1 == flight.fragments;
  const bool last_stage = stage + 1 == stages_.size();
  const bool by_datagram = wireless_.order == ServiceOrder::datagram_uplink;
  c.busy[static_cast<std::size_t>(traffic_class(flight.packet))] += run_.now - c.serving_since;
  step<fsm::channel::ServiceFinished>(channel);

  if (by_datagram && last && !last_stage) {
    for (std::uint32_t k = 0; k < flight.fragments; ++k) request(slot, k, stage + 1);
  }
  if (stage == 0 && !last && wireless_.fragment_request == FragmentRequest::sequential) {
    request(slot, fragment + 1, 0);
  }
  if (!by_datagram && !last_stage) request(slot, fragment, stage + 1);
  if (stage == 0 && last) leave_source(slot);
  if (last_stage && last) arrive(slot);
  step<fsm::channel::EffectsDone>(channel);
}

void Network::leave_source(std::uint32_t slot) {
  const InFlight& flight = flights_[slot];
  admitted_bytes_ -= flight.demand;
  sources_[flight.source].release(flight.demand);
  if (run_.who_hears(Report::source_completed) != nullptr)
    run_.probe->source_completed(flight.packet);
  implementation_->source_completed(flight.packet);
  admit(flight.source);
}

void Network::arrive(std::uint32_t slot) {
  InFlight& flight = flights_[slot];
  renew_bitmap(flight);
  const bool lost = is_lost(flight.packet.number);
  if (run_.who_hears(Report::arrived) != nullptr) run_.probe->arrived(flight.packet, lost);
  if (!lost) {
    note_latency(flight, run_.now);
    if (implementation_->receives_separately()) {
      schedule_receptions(slot, run_.now);
    } else {
      note_journey(flight);
      if (run_.who_hears(Report::received) != nullptr)
        run_.probe->received(flight.packet, Probe::everybody);
      hand_over(flight.packet, 0);
    }
  }
  release(slot);
}

void Network::hand_over(const Packet& packet, std::uint32_t receiver) {
  const bool stays = !packet.multicast() && !run_.topology.pair(packet.pair).cross_host;
  if (traffic_class(packet) != TrafficClass::repair_data || stays) {
    return implementation_->received(packet, receiver);
  }
  const std::uint64_t before = run_.useful_deliveries;
  implementation_->received(packet, receiver);
  ++repairs_received_;
  if (run_.useful_deliveries > before) ++useful_repairs_;
}

/// One reception event for each participant that the packet reaches over the network.
void Network::schedule_receptions(std::uint32_t slot, Nanoseconds time) {
  InFlight& flight = flights_[slot];
  if (flight.packet.to_nobody) return;
  if (const std::optional<std::uint32_t> receiver = destination_of(flight.packet)) {
    flight.uses += run_.schedule(time, EventKind::reception, slot, *receiver);
    return;
  }
  for (const std::uint32_t receiver : implementation_->receivers(flight.packet)) {
    flight.uses += run_.schedule(time, EventKind::reception, slot, receiver);
  }
}

void Network::loop_back(Packet&& packet, std::uint32_t receiver) {
  const std::uint32_t slot = allocate(receiver);
  flights_[slot].packet = std::move(packet);
  loop_back_flight(slot, receiver);
}

void Network::loop_back(const PacketNumbers& packet, std::uint32_t receiver) {
  const std::uint32_t slot = allocate(receiver);
  flights_[slot].packet.become(packet);
  loop_back_flight(slot, receiver);
}

void Network::loop_back_flight(std::uint32_t slot, std::uint32_t receiver) {
  InFlight& flight = flights_[slot];
  Packet& packet = flight.packet;
  packet.emitted = run_.now;
  if (processors_ != nullptr && !packet.multicast()) processors_->send(packet, 1);
  if (run_.who_hears(Report::looped_back) != nullptr) run_.probe->looped_back(packet, receiver);
  flight.admitted = run_.now;
  flight.uses += run_.schedule(run_.now + run_.scenario.deployment.loopback_delay,
                               EventKind::reception, slot, receiver);
  release(slot);
}

void Network::emit_with_delay(std::uint32_t source, Packet&& packet) {
  while (true) {
    const bool last_copy = packet.copies == 1;
    const std::uint32_t slot = allocate(source);
    InFlight& flight = flights_[slot];
    if (last_copy)
      flight.packet = std::move(packet);
    else
      SourceQueue::take_copy(packet, flight.packet, next_recipient());
    flight.admitted = run_.now;
    if (counts_at_admission_) implementation_->count(flight.packet);
    const PacketDelay delay = delay_of(flight.packet.number);
    if (implementation_->receives_separately()) {
      if (!is_lost(flight.packet.number)) schedule_receptions(slot, run_.now + delay.one_way);
    } else {
      flight.uses +=
          run_.schedule(run_.now + delay.leaves_after, EventKind::source_completion, slot);
      flight.uses += run_.schedule(run_.now + delay.one_way, EventKind::delayed_reception, slot);
    }
    release(slot);
    if (last_copy) return;
  }
}

PacketDelay Network::delay_of(std::uint64_t number) const {
  const auto& delays = wireless_.packet_delays;
  const auto found = std::lower_bound(
      delays.begin(), delays.end(), number,
      [](const PacketDelay& delay, std::uint64_t wanted) { return delay.packet < wanted; });
  if (found != delays.end() && found->packet == number) return *found;
  return {number, Nanoseconds{0}, wireless_.one_way};
}

bool Network::is_lost(std::uint64_t number) const {
  return !wireless_.lost_packets.empty() &&
         std::binary_search(wireless_.lost_packets.begin(), wireless_.lost_packets.end(), number);
}

void Network::note_latency(const InFlight& flight, Nanoseconds received) {
  Latency& latency = latency_[static_cast<std::size_t>(traffic_class(flight.packet))];
  ++latency.packets;
  latency.backlog_sum += flight.admitted - flight.packet.emitted;
  latency.service_sum += received - flight.admitted;
  latency.longest = std::max(latency.longest, received - flight.packet.emitted);
}

/// Of the mistake that an ACKNACK's bitmap is not a snapshot.
void Network::renew_bitmap(InFlight& flight) {
  if (run_.mutation == nullptr || !run_.mutation->live_bitmaps) return;
  if (flight.packet.kind == PacketKind::acknack) implementation_->renew_bitmap(flight.packet);
}

void Network::note_journey(const InFlight& flight) {
  if (run_.complete()) return;  // discovery is over; the packet that completed it is known
  last_arrival_ = LastDelivery{
      {}, !flight.packet.carries_initial, flight.packet.emitted, flight.admitted, run_.now};
}

Depths Network::depths() const {
  Depths depths;
  depths.events = run_.queue.size();
  depths.missing = run_.missing;
  depths.backlog_packets = backlog_packets_;
  depths.admitted_bytes = admitted_bytes_;
  for (const ChannelState& channel : channels_) depths.waiting += channel.waiting.size();
  for (const UnitChannel& units : units_) depths.waiting += units.size();
  for (const auto& [beacon, held] : held_frames_) depths.waiting += held.size();
  return depths;
}

void Network::report(RunResult& result) const {
  for (const ChannelState& c : channels_) {
    ChannelUse use{c.name, c.busy};
    if (c.serves && by_unit_) {
      add_use(c, use.busy, result.end_time);
    } else if (c.serves) {
      const Packet& packet = flights_[c.serving.slot].packet;
      use.busy[static_cast<std::size_t>(traffic_class(packet))] +=
          result.end_time - c.serving_since;
    }
    result.channels.push_back(use);
  }
  for (const SourceQueue& source : sources_) result.backlog.push_back(source.peak());
  for (std::uint32_t i = 0; (sender_stalls_ || processors_ != nullptr) && i < sources_.size();
       ++i) {
    Waiting& waiting = result.waiting.emplace_back();
    if (sender_stalls_) waiting.sender = stalled_[i].sum;
    if (sender_stalls_ && stalled_[i].stalls) waiting.sender += run_.now - stalled_[i].since;
    if (processors_ != nullptr) waiting.thread = processors_->waited(i);
  }
  result.latency = latency_;
  if (drops_frames_) result.dropped = dropped_;
  result.repairs_received = repairs_received_;
  result.useful_repairs = useful_repairs_;
  // Where types are looked up, an answer that another packet brings may complete discovery.
  const bool is_known = last_arrival_ && !run_.scenario.deployment.types;
  if (!result.completed() || !is_known) return;
  result.last_delivery = last_arrival_;
  result.last_delivery->descriptor = run_.last_delivered;
}

}  // namespace stormproof::model
