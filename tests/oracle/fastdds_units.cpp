// The channel of `service: unit`: whose turn it is, what goes into a unit, how long it takes, and
// what follows from its end. Every choice is made by looking at everything.
#include <algorithm>

#include "tests/oracle/fastdds_world.hpp"
#include "tests/oracle/oracle_sizes.hpp"

namespace stormproof::oracle::fastdds {

namespace {

const model::WirelessProfile& wireless(const World& w) { return w.scenario.wireless; }

bool has_flows(const World& w) { return wireless(w).queueing == model::Queueing::flows; }

bool is_access_point(const World& w, Id transmitter) { return transmitter >= host_total(w); }

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

bool something_waits(const Air& air) {
  return std::any_of(air.transmitters.begin(), air.transmitters.end(),
                     [](const auto& entry) { return waits(entry.second); });
}

std::uint64_t least_request(const UnitQueue& queue) {
  return queue.returned ? queue.returned->number : queue.frames.front().number;
}

void schedule_dispatch(World& w, const std::string& radio) {
  Air& air = w.airs[radio];
  if (air.busy || air.dispatch_pending || !something_waits(air)) return;
  air.dispatch_pending = true;
  Event event;
  event.kind = EventKind::dispatch;
  event.channel = radio;
  schedule(w, w.now, EventClass::dispatch, event);
}

bool keeps_flows(const World& w, Id transmitter, Id queue) {
  return has_flows(w) && !(is_access_point(w, transmitter) && queue == 0);
}

/// Smaller is earlier.
std::uint64_t turn(const World& w, const Air& air, std::uint64_t chosen) {
  return w.makes(WifiMistake::chosen_first_again) ? air.choices - chosen : chosen;
}

Id next_queue(const World& w, const Air& air, Id number) {
  const Transmitter& transmitter = air.transmitters.at(number);
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

Id next_transmitter(const World& w, const Air& air) {
  const bool turns = wireless(w).arbitration == model::Arbitration::round_robin ||
                     w.makes(WifiMistake::oldest_in_turns);
  std::optional<std::pair<std::uint64_t, Id>> best;
  for (const auto& [id, transmitter] : air.transmitters) {
    if (!waits(transmitter)) continue;
    std::uint64_t rank = turns ? turn(w, air, transmitter.chosen)
                               : least_request(transmitter.queues.at(next_queue(w, air, id)));
    if (w.makes(WifiMistake::first_transmitter_first)) rank = 0;
    if (w.makes(WifiMistake::access_point_first) && is_access_point(w, id)) return id;
    if (!best || rank < best->first) best = {rank, id};
  }
  return best->second;
}

std::vector<Frame>::iterator first_of(UnitQueue& queue, const std::string& flow) {
  return std::find_if(queue.frames.begin(), queue.frames.end(),
                      [&](const Frame& frame) { return frame.flow == flow; });
}

std::optional<Frame> next_frame_of_flows(World& w, UnitQueue& queue) {
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
      const Frame taken = take_from_line(w, queue, flow);
      deficit -= taken.bytes;
      return taken;
    }
  }
  return std::nullopt;
}

std::optional<Frame> next_frame(World& w, UnitQueue& queue, bool flows) {
  if (queue.returned) {
    const Frame taken = *queue.returned;
    queue.returned.reset();
    return taken;
  }
  if (flows) return next_frame_of_flows(w, queue);
  if (queue.frames.empty()) return std::nullopt;
  return take_from_line(w, queue, queue.frames.front().flow);
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

bool fits(const World& w, std::int64_t bytes, model::BitsPerSecond rate) {
  const model::Aggregation& limits = wireless(w).aggregation;
  const std::int64_t extra =
      w.makes(WifiMistake::overhead_in_airtime) ? limits.overhead.count() : 0;
  const std::int64_t airtime = transmission(bytes, rate) + extra;
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

std::vector<Frame> fill(World& w, UnitQueue& queue, bool flows, model::BitsPerSecond rate) {
  std::vector<Frame> unit{*next_frame(w, queue, flows)};
  const std::size_t most = wireless(w).aggregation.max_frames;
  const std::size_t less = w.makes(WifiMistake::limit_of_frames_early) ? 1 : 0;
  while (unit.size() + less < most) {
    const std::optional<Frame> frame = next_frame(w, queue, flows);
    if (!frame) break;
    if (!fits(w, bytes_of(w, unit) + in_unit(w, frame->bytes), rate)) {
      put_back(w, queue, *frame, flows);
      break;
    }
    unit.push_back(*frame);
  }
  return unit;
}

Time cost(const World& w, const std::vector<Frame>& unit, bool multicast,
          model::BitsPerSecond rate) {
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
  return overhead.count() + transmission(bytes, rate);
}

}  // namespace

void request_unit(World& w, const Packet& packet, std::size_t fragment, bool down,
                  const std::string& access_point) {
  Frame frame;
  frame.number = w.requests;
  ++w.requests;
  frame.packet = packet.id;
  frame.fragment = fragment;
  frame.bytes = packet.fragments.at(fragment);
  frame.since = w.now;

  const std::vector<std::string> all = access_points(w);
  const auto number = std::find(all.begin(), all.end(), access_point) - all.begin();
  const Id from =
      down ? host_total(w) + static_cast<Id>(number) : w.participants.at(packet.source).host;
  const bool multicast = !packet.destination.has_value();
  const Id to = !down || multicast ? 0 : 1 + w.participants.at(*packet.destination).host;
  const std::string radio = radio_of(w, access_point);
  Transmitter& transmitter = w.airs[radio].transmitters[from];
  UnitQueue& queue = transmitter.queues[to];
  if (down) queue.access_point = access_point;
  frame.flow = keeps_flows(w, from, to) ? flow_of(w, packet) : "";
  if (!finds_room(w, transmitter, queue, frame)) {
    w.drops.push_back({frame, queue.access_point});
    schedule_dispatch(w, radio);
    return;
  }
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
  shorten(w, transmitter, queue);
  schedule_dispatch(w, radio);
}

namespace {

/// Sends what failed again and again; returns how long all of it takes.
Time with_retries(World& w, Air& air, Id station, model::BitsPerSecond rate) {
  std::map<std::size_t, Frame> left;
  for (std::size_t k = 0; k < air.unit.size(); ++k) left[k] = air.unit.at(k);
  air.fails.assign(air.unit.size(), false);
  Time sum = 0;
  for (std::uint32_t round = 0; !left.empty(); ++round) {
    std::vector<Frame> frames;
    for (const auto& [k, frame] : left) frames.push_back(frame);
    if (round == 0 || !w.makes(WifiMistake::retries_free)) sum += cost(w, frames, false, rate);
    std::map<std::size_t, Frame> failed;
    for (const auto& [k, frame] : left) {
      if (transmission_fails(w, station)) failed[k] = frame;
    }
    left = failed;
    if (round < wireless(w).loss->retries) continue;
    for (const auto& [k, frame] : left) air.fails.at(k) = true;
    break;
  }
  return sum;
}

}  // namespace

void dispatch_unit(World& w, const std::string& radio) {
  Air& air = w.airs[radio];
  air.dispatch_pending = false;
  if (air.busy || !something_waits(air)) return;
  const Id from = next_transmitter(w, air);
  const Id to = next_queue(w, air, from);
  ++air.choices;
  Transmitter& transmitter = air.transmitters.at(from);
  UnitQueue& queue = transmitter.queues.at(to);
  transmitter.chosen = air.choices;
  queue.chosen = air.choices;

  air.down = is_access_point(w, from);
  if (air.down) air.access_point = access_points(w).at(from - host_total(w));
  bool multicast = air.down && to == 0;
  const Id station = air.down && to > 0 ? to - 1 : from;
  const model::BitsPerSecond rate{
      rate_of(w, air.down && to == 0 ? host_total(w) : station, wireless(w).rate_unicast.count())};
  if (multicast && !w.makes(WifiMistake::multicast_in_units)) {
    air.unit = {*next_frame(w, queue, false)};
  } else {
    air.unit = fill(w, queue, keeps_flows(w, from, to), rate);
  }
  const Packet& first = w.packets.at(air.unit.front().packet);
  if (w.makes(WifiMistake::multicast_up) && !first.destination && air.unit.size() == 1) {
    multicast = true;
  }
  air.fails.assign(air.unit.size(), false);
  air.deaf.clear();
  Time duration = cost(w, air.unit, multicast, rate);
  if (wireless(w).loss && air.down && to == 0) {
    air.deaf = deaf_to_multicast(w, first, air.access_point);
  } else if (wireless(w).loss) {
    duration = with_retries(w, air, station, rate);
  }
  air.busy = true;
  Event event;
  event.kind = EventKind::service_finished;
  event.channel = radio;
  schedule(w, w.now + duration, EventClass::service, event);
}

void unit_finished(World& w, const std::string& radio) {
  Air& air = w.airs[radio];
  air.busy = false;
  const Air sent = air;
  std::vector<std::uint64_t> later;
  for (std::size_t k = 0; k < sent.unit.size(); ++k) {
    const Frame& frame = sent.unit.at(k);
    const Packet packet = w.packets.at(frame.packet);
    const bool last = frame.fragment + 1 == packet.fragments.size();
    const bool fails = sent.fails.at(k) && !w.makes(WifiMistake::losses_received);
    if (sent.down) {
      Packet& known = w.packets.at(frame.packet);
      known.deaf.insert(sent.deaf.begin(), sent.deaf.end());
      if (fails) known.deaf.insert(w.participants.at(*packet.destination).host);
      if (last) arrive_at(w, known, sent.access_point);
      continue;
    }
    if (fails) w.packets.at(frame.packet).stopped = true;
    if (!fails) distribute(w, packet.id, frame.fragment);
    if (++w.packets.at(packet.id).gone < packet.fragments.size()) continue;
    if (w.makes(WifiMistake::admission_after_the_unit)) {
      later.push_back(packet.id);
    } else {
      leave_source(w, packet);
    }
  }
  for (const std::uint64_t id : later) leave_source(w, w.packets.at(id));
  schedule_dispatch(w, radio);
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
    settle_drops(w);
  }
  return arrived;
}

}  // namespace stormproof::oracle
