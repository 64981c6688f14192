// Whose turn it is, what fits into a unit, and what a queue drops.
#include "model/engine/unit_channel.hpp"

#include <algorithm>
#include <limits>

namespace stormproof::model {

UnitChannel::UnitChannel(const WirelessProfile& wireless, std::uint32_t hosts,
                         std::uint32_t access_points)
    : limits_{wireless.aggregation},
      management_{wireless.queue.value_or(QueueManagement{})},
      in_turns_{wireless.arbitration == Arbitration::round_robin},
      queues_in_turns_{wireless.ap_queue == ApQueue::round_robin ||
                       wireless.queueing == Queueing::flows},
      hosts_{hosts},
      unicast_(hosts, {wireless.overhead_unicast.count(), wireless.rate_unicast.count()}),
      multicast_{wireless.overhead_multicast.count(), wireless.rate_multicast.count()} {
  const std::int64_t quantum = wireless.queueing == Queueing::flows ? wireless.quantum.count() : 0;
  transmitters_.resize(hosts_ + access_points);
  for (std::uint32_t host = 0; host < hosts; ++host) {
    transmitters_[host].queues.push_back({FrameQueue{quantum}});
  }
  for (std::size_t k = hosts_; k < transmitters_.size(); ++k) {
    transmitters_[k].queues.push_back({FrameQueue{0}});  // multicast
    for (std::uint32_t host = 0; host < hosts; ++host) {
      transmitters_[k].queues.push_back({FrameQueue{quantum}});
    }
  }
  manage_queues(wireless);
}

void UnitChannel::manage_queues(const WirelessProfile& wireless) {
  const bool measures = management_.discipline == QueueDiscipline::codel ||
                        management_.discipline == QueueDiscipline::fq_codel;
  for (std::size_t k = 0; k < transmitters_.size(); ++k) {
    Transmitter& transmitter = transmitters_[k];
    if (k >= hosts_) transmitter.access_point = static_cast<std::uint32_t>(k - hosts_);
    const QueuesOf others = k < hosts_ ? QueuesOf::access_points : QueuesOf::stations;
    if (management_.of == others) continue;
    transmitter.discipline = management_.discipline;
    if (!measures) continue;
    transmitter.codel = {management_.target.count(), management_.interval.count(),
                         Fragmentation{wireless}.longest()};
  }
}

Unit UnitChannel::take(Nanoseconds now) {
  const std::size_t chosen = choose_transmitter();
  Transmitter& transmitter = transmitters_[chosen];
  const std::size_t number = choose_queue(transmitter);
  Queue& queue = transmitter.queues[number];
  transmitter.chosen = queue.chosen = ++choices_;

  Unit unit;
  unit.downlink = chosen >= hosts_;
  unit.multicast = unit.downlink && number == 0;
  if (unit.downlink) unit.access_point = *transmitter.access_point;
  if (unit.multicast) {
    unit.rate = multicast_;
    unit.frames.push_back(*next_frame(transmitter, queue.frames, now));
    unit.duration_ns = multicast_.airtime_ns(unit.frames.front().bytes);
  } else {
    unit.host = static_cast<std::uint32_t>(unit.downlink ? number - 1 : chosen);
    unit.rate = unicast_[unit.host];
    fill(unit, transmitter, queue.frames, now);
  }
  return unit;
}

std::optional<DroppedFrame> UnitChannel::next_dropped() {
  if (dropped_.empty()) return std::nullopt;
  const DroppedFrame first = dropped_.front();
  dropped_.pop_front();
  return first;
}

/// Where flows are kept apart, what is over the limit is taken from the longest one; otherwise the
/// frame itself finds no room.
void UnitChannel::push(Transmitter& transmitter, std::size_t queue, const Frame& frame,
                       const Flow& flow) {
  joins(transmitter, frame);
  if (transmitter.discipline != QueueDiscipline::fq_codel && is_over_limit(transmitter)) {
    leaves(transmitter, frame);
    return drop(transmitter, frame);
  }
  transmitter.queues[queue].frames.push(frame, flow);
  while (is_over_limit(transmitter)) shorten(transmitter);
}

bool UnitChannel::is_over_limit(const Transmitter& transmitter) const {
  if (transmitter.discipline == QueueDiscipline::unlimited) return false;
  return (management_.max_frames && transmitter.limited_frames > *management_.max_frames) ||
         (management_.max_bytes && transmitter.limited_bytes > management_.max_bytes->count());
}

/// The line with the most bytes loses half of its frames, 64 at most, from its head (RFC
/// 8290, 4.1).
void UnitChannel::shorten(Transmitter& transmitter) {
  FrameQueue* queue = nullptr;
  FrameQueue::Line* longest = nullptr;
  for (Queue& one : transmitter.queues) {
    FrameQueue::Line* const line = FrameQueue::longer(longest, one.frames.longest());
    if (line != longest) queue = &one.frames;
    longest = line;
  }
  constexpr std::size_t most = 64;
  for (std::size_t k = std::min((longest->frames.size() + 1) / 2, most); k > 0; --k) {
    const Frame frame = queue->take_head(*longest);
    leaves(transmitter, frame);
    drop(transmitter, frame);
  }
}

void UnitChannel::joins(Transmitter& transmitter, const Frame& frame) {
  wait(transmitter, 1);
  ++transmitter.limited_frames;
  transmitter.limited_bytes += frame.bytes;
}

void UnitChannel::leaves(Transmitter& transmitter, const Frame& frame) {
  wait(transmitter, -1);
  --transmitter.limited_frames;
  transmitter.limited_bytes -= frame.bytes;
}

void UnitChannel::wait(Transmitter& transmitter, int frames) {
  transmitter.waiting += static_cast<std::size_t>(frames);
  waiting_ += static_cast<std::size_t>(frames);
}

/// What did not fit into a unit has left its line already.
std::optional<Frame> UnitChannel::next_frame(Transmitter& transmitter, FrameQueue& queue,
                                             Nanoseconds now) {
  if (queue.has_returned()) {
    wait(transmitter, -1);
    return queue.take_returned();
  }
  std::vector<Frame> late;
  const std::optional<Frame> frame = queue.next(transmitter.codel, now, late);
  for (const Frame& one : late) {
    leaves(transmitter, one);
    drop(transmitter, one);
  }
  if (frame) leaves(transmitter, *frame);
  return frame;
}

std::size_t UnitChannel::choose_transmitter() const {
  std::size_t best = transmitters_.size();
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
  for (std::size_t k = 0; k < transmitters_.size(); ++k) {
    const Transmitter& transmitter = transmitters_[k];
    if (transmitter.waiting == 0) continue;
    const std::uint64_t rank =
        in_turns_ ? transmitter.chosen
                  : transmitter.queues[choose_queue(transmitter)].frames.head().number;
    if (best < transmitters_.size() && rank >= least) continue;
    best = k;
    least = rank;
  }
  return best;
}

std::size_t UnitChannel::choose_queue(const Transmitter& transmitter) const {
  std::size_t best = transmitter.queues.size();
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
  for (std::size_t k = 0; k < transmitter.queues.size(); ++k) {
    const Queue& queue = transmitter.queues[k];
    if (queue.frames.empty()) continue;
    if (transmitter.queues.size() == 1) return k;
    const std::uint64_t rank = queues_in_turns_ ? queue.chosen : queue.frames.head().number;
    if (best < transmitter.queues.size() && rank >= least) continue;
    best = k;
    least = rank;
  }
  return best;
}

/// The first frame always, further ones as long as they fit.
void UnitChannel::fill(Unit& unit, Transmitter& transmitter, FrameQueue& queue, Nanoseconds now) {
  unit.frames.push_back(*next_frame(transmitter, queue, now));
  std::int64_t bytes = padded(unit.frames.front().bytes);
  while (unit.frames.size() < limits_.max_frames) {
    const std::optional<Frame> frame = next_frame(transmitter, queue, now);
    if (!frame) break;
    const std::int64_t longer = bytes + padded(frame->bytes);
    if (longer > limits_.max_bytes.count() ||
        airtime_ns(longer, unit.rate) > limits_.max_airtime.count()) {
      queue.put_back(*frame);
      wait(transmitter, 1);
      break;
    }
    bytes = longer;
    unit.frames.push_back(*frame);
  }
  unit.duration_ns = duration_ns(unit.frames, unit.rate);
}

std::int64_t UnitChannel::duration_ns(const std::vector<Frame>& frames,
                                      const ServiceRate& rate) const {
  if (frames.size() == 1) return rate.airtime_ns(frames.front().bytes);
  std::int64_t bytes = 0;
  for (const Frame& frame : frames) bytes += padded(frame.bytes);
  return limits_.overhead.count() + airtime_ns(bytes, rate);
}

}  // namespace stormproof::model
