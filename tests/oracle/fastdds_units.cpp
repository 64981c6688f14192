// The channel of `service: unit`: whose turn it is, what goes into a unit, how long it takes, and
// what follows from its end. Every choice is made by looking at everything.
#include <algorithm>

#include "tests/oracle/fastdds_world.hpp"
#include "tests/oracle/oracle_sizes.hpp"

namespace stormproof::oracle::fastdds {

namespace {

const model::WirelessProfile& wireless(const World& w) { return w.scenario.wireless; }

bool has_flows(const World& w) { return wireless(w).queueing == model::Queueing::flows; }

Id access_point(const World& w) {
  Id most = 0;
  for (const Participant& p : w.participants) most = std::max(most, p.host);
  return most + 1;
}

std::string flow_of(const World& w, const Packet& packet) {
  const bool multicast = !packet.destination.has_value();
  const std::string everybody = w.makes(WifiMistake::flows_of_multicast) ? "0" : "all";
  const bool whole = packet.fragments.size() == 1;
  if (whole || w.makes(WifiMistake::fragments_by_participant)) {
    const int port = w.makes(WifiMistake::ports_ignored) || !whole ? 0 : packet.port;
    return std::to_string(packet.source) + " to " +
           (multicast ? everybody : std::to_string(*packet.destination)) + " at " +
           std::to_string(port);
  }
  const std::string to =
      multicast ? "all" : std::to_string(w.participants.at(*packet.destination).host);
  return "host " + std::to_string(w.participants.at(packet.source).host) + " to " + to;
}

bool is_empty(const UnitQueue& queue) { return queue.frames.empty() && !queue.returned; }

bool waits(const Transmitter& transmitter) {
  return std::any_of(transmitter.queues.begin(), transmitter.queues.end(),
                     [](const auto& entry) { return !is_empty(entry.second); });
}

bool something_waits(const World& w) {
  return std::any_of(w.air.transmitters.begin(), w.air.transmitters.end(),
                     [](const auto& entry) { return waits(entry.second); });
}

std::uint64_t least_request(const UnitQueue& queue) {
  return queue.returned ? queue.returned->number : queue.frames.front().number;
}

void schedule_dispatch(World& w) {
  if (w.air.busy || w.air.dispatch_pending || !something_waits(w)) return;
  w.air.dispatch_pending = true;
  Event event;
  event.kind = EventKind::dispatch;
  schedule(w, w.now, EventClass::dispatch, event);
}

bool keeps_flows(const World& w, Id transmitter, Id queue) {
  return has_flows(w) && !(transmitter == access_point(w) && queue == 0);
}

/// Smaller is earlier.
std::uint64_t turn(const World& w, std::uint64_t chosen) {
  return w.makes(WifiMistake::chosen_first_again) ? w.air.choices - chosen : chosen;
}

Id next_queue(const World& w, Id number) {
  const Transmitter& transmitter = w.air.transmitters.at(number);
  const bool turns = has_flows(w) || wireless(w).ap_queue == model::ApQueue::round_robin ||
                     w.makes(WifiMistake::queues_in_turns);
  std::optional<std::pair<std::uint64_t, Id>> best;
  for (const auto& [id, queue] : transmitter.queues) {
    if (is_empty(queue)) continue;
    std::uint64_t rank = turns ? queue.chosen : least_request(queue);
    if (w.makes(WifiMistake::queues_by_number)) rank = 0;
    if (!best || rank < best->first) best = {rank, id};
  }
  return best->second;
}

Id next_transmitter(const World& w) {
  const bool turns = wireless(w).arbitration == model::Arbitration::round_robin ||
                     w.makes(WifiMistake::oldest_in_turns);
  std::optional<std::pair<std::uint64_t, Id>> best;
  for (const auto& [id, transmitter] : w.air.transmitters) {
    if (!waits(transmitter)) continue;
    std::uint64_t rank = turns ? turn(w, transmitter.chosen)
                               : least_request(transmitter.queues.at(next_queue(w, id)));
    if (w.makes(WifiMistake::first_transmitter_first)) rank = 0;
    if (w.makes(WifiMistake::access_point_first) && id == access_point(w)) return id;
    if (!best || rank < best->first) best = {rank, id};
  }
  return best->second;
}

std::vector<Frame>::iterator first_of(UnitQueue& queue, const std::string& flow) {
  return std::find_if(queue.frames.begin(), queue.frames.end(),
                      [&](const Frame& frame) { return frame.flow == flow; });
}

std::optional<Frame> next_frame_of_flows(const World& w, UnitQueue& queue) {
  while (!queue.new_flows.empty() || !queue.old_flows.empty()) {
    const bool is_new = !queue.new_flows.empty();
    std::vector<std::string>& list = is_new ? queue.new_flows : queue.old_flows;
    const std::string flow = list.front();
    std::int64_t& deficit = queue.deficits[flow];
    const auto frame = first_of(queue, flow);
    const bool goes_on = w.makes(WifiMistake::zero_deficit_goes_on) && deficit == 0;
    if (deficit <= 0 && !goes_on) {
      deficit += wireless(w).quantum.count();
      list.erase(list.begin());
      queue.old_flows.push_back(flow);
    } else if (frame == queue.frames.end()) {
      list.erase(list.begin());
      const bool others = !queue.old_flows.empty() && !w.makes(WifiMistake::empty_flow_leaves);
      if (is_new && others) queue.old_flows.push_back(flow);
    } else {
      const Frame taken = *frame;
      queue.frames.erase(frame);
      deficit -= taken.bytes;
      return taken;
    }
  }
  return std::nullopt;
}

std::optional<Frame> next_frame(const World& w, UnitQueue& queue, bool flows) {
  if (queue.returned) {
    const Frame taken = *queue.returned;
    queue.returned.reset();
    return taken;
  }
  if (flows) return next_frame_of_flows(w, queue);
  if (queue.frames.empty()) return std::nullopt;
  const Frame taken = queue.frames.front();
  queue.frames.erase(queue.frames.begin());
  return taken;
}

void put_back(const World& w, UnitQueue& queue, const Frame& frame, bool flows) {
  const bool in_flow = flows && w.makes(WifiMistake::returned_frame_in_flow);
  if (flows && w.makes(WifiMistake::returned_frame_uncharged)) {
    queue.deficits[frame.flow] += frame.bytes;
  }
  if (in_flow) {
    queue.frames.insert(queue.frames.begin(), frame);
  } else {
    queue.returned = frame;
  }
}

std::int64_t in_unit(const World& w, std::int64_t bytes) {
  const std::int64_t padded = w.makes(WifiMistake::no_padding) ? bytes : 4 * ceil_div(bytes, 4);
  return padded + (w.makes(WifiMistake::no_delimiter) ? 0 : 4);
}

std::int64_t transmission(std::int64_t bytes, model::BitsPerSecond rate) {
  return (8 * bytes * 1'000'000'000 + rate.count() / 2) / rate.count();
}

bool fits(const World& w, std::int64_t bytes) {
  const model::Aggregation& limits = wireless(w).aggregation;
  const std::int64_t extra =
      w.makes(WifiMistake::overhead_in_airtime) ? limits.overhead.count() : 0;
  const std::int64_t airtime = transmission(bytes, wireless(w).rate_unicast) + extra;
  const std::int64_t bytes_less = w.makes(WifiMistake::limit_of_bytes_excluded) ? 1 : 0;
  const std::int64_t airtime_less = w.makes(WifiMistake::limit_of_airtime_excluded) ? 1 : 0;
  return bytes <= limits.max_bytes.count() - bytes_less &&
         airtime <= limits.max_airtime.count() - airtime_less;
}

std::int64_t bytes_of(const World& w, const std::vector<Frame>& frames) {
  std::int64_t sum = 0;
  for (const Frame& frame : frames) sum += in_unit(w, frame.bytes);
  return sum;
}

std::vector<Frame> fill(const World& w, UnitQueue& queue, bool flows) {
  std::vector<Frame> unit{*next_frame(w, queue, flows)};
  const std::size_t most = wireless(w).aggregation.max_frames;
  const std::size_t less = w.makes(WifiMistake::limit_of_frames_early) ? 1 : 0;
  while (unit.size() + less < most) {
    const std::optional<Frame> frame = next_frame(w, queue, flows);
    if (!frame) break;
    if (!fits(w, bytes_of(w, unit) + in_unit(w, frame->bytes))) {
      put_back(w, queue, *frame, flows);
      break;
    }
    unit.push_back(*frame);
  }
  return unit;
}

Time cost(const World& w, const std::vector<Frame>& unit, bool multicast) {
  const model::WirelessProfile& profile = wireless(w);
  if (multicast) {
    return profile.overhead_multicast.count() +
           transmission(unit.front().bytes, profile.rate_multicast);
  }
  const bool alone = unit.size() == 1;
  const bool as_one = alone || w.makes(WifiMistake::overhead_of_one_frame);
  const bool padded = !alone || w.makes(WifiMistake::one_frame_padded);
  const std::int64_t bytes = padded ? bytes_of(w, unit) : unit.front().bytes;
  const model::Nanoseconds overhead =
      as_one ? profile.overhead_unicast : profile.aggregation.overhead;
  return overhead.count() + transmission(bytes, profile.rate_unicast);
}

}  // namespace

void request_unit(World& w, const Packet& packet, std::size_t fragment, bool down) {
  Frame frame;
  frame.number = w.requests;
  ++w.requests;
  frame.packet = packet.id;
  frame.fragment = fragment;
  frame.bytes = packet.fragments.at(fragment);
  frame.flow = flow_of(w, packet);

  const Id from = down ? access_point(w) : w.participants.at(packet.source).host;
  const bool multicast = !packet.destination.has_value();
  const Id to = !down || multicast ? 0 : 1 + w.participants.at(*packet.destination).host;
  UnitQueue& queue = w.air.transmitters[from].queues[to];
  queue.frames.push_back(frame);

  const auto lists = [&](const std::vector<std::string>& list) {
    return std::find(list.begin(), list.end(), frame.flow) != list.end();
  };
  if (keeps_flows(w, from, to) && !lists(queue.new_flows) && !lists(queue.old_flows)) {
    const bool known = queue.deficits.contains(frame.flow);
    if (!known || !w.makes(WifiMistake::deficit_kept)) {
      queue.deficits[frame.flow] = wireless(w).quantum.count();
    }
    (w.makes(WifiMistake::new_flows_behind_old) ? queue.old_flows : queue.new_flows)
        .push_back(frame.flow);
  }
  schedule_dispatch(w);
}

void dispatch_unit(World& w) {
  w.air.dispatch_pending = false;
  if (w.air.busy || !something_waits(w)) return;
  const Id from = next_transmitter(w);
  const Id to = next_queue(w, from);
  ++w.air.choices;
  Transmitter& transmitter = w.air.transmitters.at(from);
  UnitQueue& queue = transmitter.queues.at(to);
  transmitter.chosen = w.air.choices;
  queue.chosen = w.air.choices;

  w.air.down = from == access_point(w);
  bool multicast = w.air.down && to == 0;
  if (multicast && !w.makes(WifiMistake::multicast_in_units)) {
    w.air.unit = {*next_frame(w, queue, false)};
  } else {
    w.air.unit = fill(w, queue, keeps_flows(w, from, to));
  }
  const Packet& first = w.packets.at(w.air.unit.front().packet);
  if (w.makes(WifiMistake::multicast_up) && !first.destination && w.air.unit.size() == 1) {
    multicast = true;
  }
  w.air.busy = true;
  Event event;
  event.kind = EventKind::service_finished;
  schedule(w, w.now + cost(w, w.air.unit, multicast), EventClass::service, event);
}

void unit_finished(World& w) {
  w.air.busy = false;
  const std::vector<Frame> unit = w.air.unit;
  std::vector<std::uint64_t> later;
  for (const Frame& frame : unit) {
    const Packet packet = w.packets.at(frame.packet);
    const bool last = frame.fragment + 1 == packet.fragments.size();
    if (w.air.down) {
      if (last) arrive(w, packet);
      continue;
    }
    request_unit(w, packet, frame.fragment, true);
    if (!last) continue;
    if (w.makes(WifiMistake::admission_after_the_unit)) {
      later.push_back(packet.id);
    } else {
      leave_source(w, packet);
    }
  }
  for (const std::uint64_t id : later) leave_source(w, w.packets.at(id));
  schedule_dispatch(w);
}

}  // namespace stormproof::oracle::fastdds

namespace stormproof::oracle {

std::vector<std::int64_t> feed_units(const model::WirelessProfile& wireless, std::uint32_t hosts,
                                     const std::vector<vectors::ChannelPacket>& packets,
                                     WifiMistake mistake) {
  using namespace fastdds;
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(hosts, 1, 0);
  scenario.wireless = wireless;
  World w{scenario, FastddsMistake::none, mistake};
  for (std::size_t k = 0; k < packets.size(); ++k) {
    Event event = make_event(EventKind::announcement, packets.at(k).source, 0, 0);
    event.number = static_cast<std::int64_t>(k);
    schedule(w, packets.at(k).time_ns, EventClass::protocol, event);
  }
  std::vector<std::int64_t> arrived(packets.size(), -1);
  while (!w.queue.empty()) {
    const auto [key, event] = *w.queue.begin();
    w.queue.erase(w.queue.begin());
    w.now = std::get<0>(key);
    if (event.kind == EventKind::announcement) {
      const vectors::ChannelPacket& fed = packets.at(static_cast<std::size_t>(event.number));
      Packet packet;
      packet.source = fed.source;
      packet.destination = fed.destination;
      packet.payload = fed.payload_bytes;
      packet.port = fed.port;
      emit(w, packet);
    } else if (event.kind == EventKind::reception) {
      arrived.at(event.packet) = w.now;
    } else if (event.kind == EventKind::dispatch) {
      dispatch(w, event.channel);
    } else {
      service_finished(w, event);
    }
  }
  return arrived;
}

}  // namespace stormproof::oracle
