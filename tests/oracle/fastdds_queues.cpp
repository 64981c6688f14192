// Queues that drop: those that find no room, CoDel by the text of RFC 8289 (section 5), and the
// longest flow at the limit by that of RFC 8290 (section 4.1). What follows from drops comes at the
// end of their event.
#include <algorithm>
#include <set>

#include "tests/oracle/fastdds_world.hpp"

namespace stormproof::oracle::fastdds {

namespace {

const model::QueueManagement* management(const World& w, const UnitQueue& queue) {
  const auto& managed = w.scenario.wireless.queue;
  if (!managed || w.makes(WifiMistake::queues_keep_all)) return nullptr;
  if (managed->discipline == model::QueueDiscipline::unlimited) return nullptr;
  const bool of_stations = managed->of == model::QueuesOf::stations;
  const bool of_points = managed->of == model::QueuesOf::access_points;
  const bool is_left_out = queue.access_point ? of_stations : of_points;
  return is_left_out && !w.makes(WifiMistake::stations_drop_too) ? nullptr : &*managed;
}

struct Sum {
  std::int64_t frames = 0;
  std::int64_t bytes = 0;
};

void add(const World& w, const UnitQueue& queue, Sum& sum) {
  std::vector<Frame> all = queue.frames;
  if (queue.returned && w.makes(WifiMistake::returned_frame_limited))
    all.push_back(*queue.returned);
  for (const Frame& frame : all) {
    ++sum.frames;
    sum.bytes += frame.bytes;
  }
}

bool is_too_much(const model::QueueManagement& managed, const Sum& sum) {
  return (managed.max_frames && sum.frames > std::int64_t{*managed.max_frames}) ||
         (managed.max_bytes && sum.bytes > managed.max_bytes->count());
}

Sum waiting(const World& w, const Transmitter& at, const UnitQueue& queue) {
  Sum sum;
  if (w.makes(WifiMistake::limit_for_each_queue)) {
    add(w, queue, sum);
    return sum;
  }
  for (const auto& [to, one] : at.queues) add(w, one, sum);
  return sum;
}

std::vector<Frame> line_of(const UnitQueue& queue, const std::string& flow) {
  std::vector<Frame> line;
  for (const Frame& frame : queue.frames) {
    if (frame.flow == flow) line.push_back(frame);
  }
  return line;
}

void remove(UnitQueue& queue, const Frame& frame) {
  std::erase_if(queue.frames, [&](const Frame& one) { return one.number == frame.number; });
}

void drop(World& w, UnitQueue& queue, const Frame& frame) {
  if (w.makes(WifiMistake::dropped_frames_charged)) queue.deficits[frame.flow] -= frame.bytes;
  w.drops.push_back({frame, queue.access_point});
}

std::int64_t bytes_of(const std::vector<Frame>& line) {
  std::int64_t sum = 0;
  for (const Frame& frame : line) sum += frame.bytes;
  return sum;
}

/// The greatest d with d²·count ≤ interval², bit by bit.
Time distance(const World& w, Time interval, std::int64_t count) {
  __extension__ using Wide = __int128;
  if (w.makes(WifiMistake::drops_at_one_distance)) count = 1;
  Time found = 0;
  for (Time bit = Time{1} << 50; bit > 0; bit /= 2) {
    const Time tried = found + bit;
    if (tried <= interval && Wide{tried} * tried * count <= Wide{interval} * interval)
      found = tried;
  }
  return found;
}

/// `dodequeue` of the RFC: the first frame of the line, and whether it may be dropped.
std::pair<Frame, bool> dodequeue(World& w, UnitQueue& queue, const std::string& flow,
                                 const model::QueueManagement& managed) {
  CodelState& state = queue.codel[flow];
  std::vector<Frame> line = line_of(queue, flow);
  const Frame first = line.front();
  remove(queue, first);
  line.erase(line.begin());
  const model::WirelessProfile& wireless = w.scenario.wireless;
  const std::int64_t longest =
      wireless.mtu_payload_bytes.count() + 20 + wireless.link_overhead_bytes.count();
  const bool few =
      line.empty() || (bytes_of(line) <= longest && !w.makes(WifiMistake::last_frames_dropped));
  const Time target = managed.target.count() + (w.makes(WifiMistake::target_excluded) ? 1 : 0);
  if (w.now - first.since < target || few) {
    state.first_above_time.reset();
    return {first, false};
  }
  if (!state.first_above_time) {
    state.first_above_time = w.now + managed.interval.count();
    return {first, w.makes(WifiMistake::first_drop_at_once)};
  }
  return {first, w.now >= *state.first_above_time};
}

}  // namespace

bool finds_room(World& w, Transmitter& at, UnitQueue& queue, const Frame& frame) {
  const model::QueueManagement* const managed = management(w, queue);
  if (managed == nullptr || managed->discipline == model::QueueDiscipline::fq_codel) return true;
  Sum sum = waiting(w, at, queue);
  ++sum.frames;
  sum.bytes += frame.bytes;
  return !is_too_much(*managed, sum);
}

void shorten(World& w, Transmitter& at, UnitQueue& joined) {
  const model::QueueManagement* const managed = management(w, joined);
  if (managed == nullptr || managed->discipline != model::QueueDiscipline::fq_codel) return;
  while (is_too_much(*managed, waiting(w, at, joined))) {
    UnitQueue* longest_at = nullptr;
    std::vector<Frame> longest;
    for (auto& [to, queue] : at.queues) {
      std::set<std::string> flows;
      for (const Frame& frame : queue.frames) flows.insert(frame.flow);
      for (const std::string& flow : flows) {
        const std::vector<Frame> line = line_of(queue, flow);
        const auto size = [&](const std::vector<Frame>& one) {
          return w.makes(WifiMistake::longest_by_frames) ? static_cast<std::int64_t>(one.size())
                                                         : bytes_of(one);
        };
        const bool equal = !longest.empty() && size(line) == size(longest);
        const bool older = equal && line.front().number < longest.front().number;
        if (!longest.empty() && size(line) <= size(longest) && !older) continue;
        longest = line;
        longest_at = &queue;
      }
    }
    if (longest_at == nullptr) return;  // only a mistake finds nothing to drop
    std::size_t some = (longest.size() + 1) / 2;
    if (w.makes(WifiMistake::longest_loses_one)) some = 1;
    if (w.makes(WifiMistake::longest_loses_all)) some = longest.size();
    if (w.makes(WifiMistake::longest_loses_newest)) std::reverse(longest.begin(), longest.end());
    for (std::size_t k = 0; k < std::min<std::size_t>(some, 64); ++k) {
      remove(*longest_at, longest.at(k));
      w.drops.push_back({longest.at(k), longest_at->access_point});
    }
  }
}

/// `deque` of the RFC, if there is CoDel; the line is not empty.
Frame take_from_line(World& w, UnitQueue& queue, const std::string& flow) {
  const model::QueueManagement* const managed = management(w, queue);
  const bool measures =
      managed != nullptr && managed->discipline != model::QueueDiscipline::tail_drop;
  if (!measures) {
    const Frame first = line_of(queue, flow).front();
    remove(queue, first);
    return first;
  }
  const Time interval = managed->interval.count();
  CodelState& state = queue.codel[flow];
  auto [frame, ok_to_drop] = dodequeue(w, queue, flow, *managed);
  if (state.dropping) {
    if (!ok_to_drop) state.dropping = false;
    while (w.now >= state.drop_next && state.dropping) {
      drop(w, queue, frame);
      ++state.count;
      std::tie(frame, ok_to_drop) = dodequeue(w, queue, flow, *managed);
      if (!ok_to_drop) {
        state.dropping = false;
      } else {
        const Time from = w.makes(WifiMistake::drops_counted_from_now) ? w.now : state.drop_next;
        state.drop_next = from + distance(w, interval, state.count);
      }
      if (w.makes(WifiMistake::one_drop_at_a_time)) break;
    }
  } else if (ok_to_drop) {
    drop(w, queue, frame);
    std::tie(frame, ok_to_drop) = dodequeue(w, queue, flow, *managed);
    state.dropping = true;
    const std::int64_t delta = state.count - state.lastcount;
    const bool soon =
        w.now - state.drop_next < 16 * interval || w.makes(WifiMistake::count_always_taken_up);
    state.count = 1;
    if (delta > 1 && soon && !w.makes(WifiMistake::every_storm_begins_anew)) state.count = delta;
    state.drop_next = w.now + distance(w, interval, state.count);
    state.lastcount = state.count;
  }
  return frame;
}

void settle_drops(World& w) {
  while (!w.drops.empty()) {
    const Drop next = w.drops.front();
    w.drops.pop_front();
    Packet& packet = w.packets.at(next.frame.packet);
    const bool last = next.frame.fragment + 1 == packet.fragments.size();
    if (!next.access_point) {
      packet.stopped = true;
      const bool gone = ++packet.gone == packet.fragments.size();
      if (gone && !w.makes(WifiMistake::dropped_packet_stays)) leave_source(w, Packet{packet});
      continue;
    }
    for (Id host = 0; host < host_total(w); ++host) {
      const bool is_meant =
          !packet.destination || w.participants.at(*packet.destination).host == host;
      const bool hears =
          !packet.destination && !last && w.makes(WifiMistake::dropped_multicast_heard);
      if (is_meant && is_station(w, host, *next.access_point) && !hears) packet.deaf.insert(host);
    }
    if (last) arrive_at(w, Packet{packet}, *next.access_point);
  }
}

}  // namespace stormproof::oracle::fastdds
