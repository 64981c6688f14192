// Whose turn it is, and what fits into a unit.
#include "model/engine/unit_channel.hpp"

#include <limits>

namespace stormproof::model {

UnitChannel::UnitChannel(const WirelessProfile& wireless, std::uint32_t hosts,
                         std::uint32_t access_points)
    : limits_{wireless.aggregation},
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
}

Unit UnitChannel::take() {
  const std::size_t chosen = choose_transmitter();
  Transmitter& transmitter = transmitters_[chosen];
  const std::size_t number = choose_queue(transmitter);
  Queue& queue = transmitter.queues[number];
  transmitter.chosen = queue.chosen = ++choices_;

  Unit unit;
  unit.downlink = chosen >= hosts_;
  unit.multicast = unit.downlink && number == 0;
  const std::size_t before = queue.frames.size();
  if (unit.downlink) unit.access_point = static_cast<std::uint32_t>(chosen - hosts_);
  if (unit.multicast) {
    unit.rate = multicast_;
    unit.frames.push_back(*queue.frames.next());
    unit.duration_ns = multicast_.airtime_ns(unit.frames.front().bytes);
  } else {
    unit.host = static_cast<std::uint32_t>(unit.downlink ? number - 1 : chosen);
    unit.rate = unicast_[unit.host];
    fill(unit, queue.frames);
  }
  const std::size_t taken = before - queue.frames.size();
  transmitter.waiting -= taken;
  waiting_ -= taken;
  return unit;
}

void UnitChannel::push(Transmitter& transmitter, std::size_t queue, const Frame& frame,
                       const Flow& flow) {
  transmitter.queues[queue].frames.push(frame, flow);
  ++transmitter.waiting;
  ++waiting_;
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
void UnitChannel::fill(Unit& unit, FrameQueue& queue) const {
  unit.frames.push_back(*queue.next());
  std::int64_t bytes = padded(unit.frames.front().bytes);
  while (unit.frames.size() < limits_.max_frames) {
    const std::optional<Frame> frame = queue.next();
    if (!frame) break;
    const std::int64_t longer = bytes + padded(frame->bytes);
    if (longer > limits_.max_bytes.count() ||
        airtime_ns(longer, unit.rate) > limits_.max_airtime.count()) {
      queue.put_back(*frame);
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
