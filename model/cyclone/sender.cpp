// Packets of Cyclone DDS, copy by copy, and what their submessages count as.
#include "model/cyclone/sender.hpp"

#include <utility>

#include "model/engine/network.hpp"

namespace stormproof::model::cyclone {

namespace {
/// Whether it was set before.
bool mark(std::vector<std::uint64_t>& bits, std::uint32_t d) {
  const std::uint64_t bit = std::uint64_t{1} << d % 64;
  const bool marked = (bits[d / 64] & bit) != 0;
  bits[d / 64] |= bit;
  return marked;
}
/// It has no lists of its own.
model::Packet copy_of(const model::Packet& packet) {
  model::Packet copy;
  copy.become(packet);
  copy.submessages = packet.submessages;
  return copy;
}
}  // namespace

Sender::Sender(RunState& run, Network& network, const EventThreads& threads)
    : run_{run},
      network_{network},
      stride_{threads.writer_layout().stride},
      delivered_to_group_(std::size_t{stride_} * run.topology.participant_count()),
      delivered_(std::size_t{stride_} * run.topology.pair_count()) {
  for (Number w = 0; w < delivered_to_group_.size(); ++w) {
    delivered_to_group_[w].resize(words_for(threads.samples_of(w)));
  }
  for (Number r = 0; r < delivered_.size(); ++r) {
    const Number writer = stride_ * run.topology.pair(r / stride_).source + r % stride_;
    delivered_[r].resize(words_for(threads.samples_of(writer)));
  }
}

/// One packet; copies to the same host do not see the channel, and are not counted.
void Sender::send(Number i, Number to, model::Packet packet) {
  const Topology& topology = run_.topology;
  if (packet.to_group) {
    for (Number pair = topology.first_pair(i); pair < topology.first_pair(i + 1); ++pair) {
      const Pair& ends = topology.pair(pair);
      if (!ends.cross_host) network_.loop_back(copy_of(packet), ends.destination);
    }
  } else if (!topology.pair(packet.pair).cross_host) {
    network_.loop_back(std::move(packet), to);
    return;
  }
  emit(i, std::move(packet));
}

bool Sender::stalls(Number i) const { return network_.stalls(i); }

void Sender::emit(Number i, model::Packet&& sent) {
  sent.use = TrafficClass::user_control;
  for (const Submessage& m : *sent.submessages) {
    const TrafficClass use = count(m, sent.pair, sent.to_group);
    if (use == TrafficClass::initial_data) ++sent.initial_data;
    if (use == TrafficClass::repair_data) ++sent.repair_data;
    sent.use = std::min(sent.use, use);
  }
  sent.carries_initial = sent.initial_data > 0;
  network_.emit(i, std::move(sent));
}

/// What a submessage is for that is neither announcement nor DATA of a stream; it counts there.
TrafficClass Sender::count_control(const Submessage& m, Counts& counts,
                                   std::uint64_t& user_control) {
  if (m.writer > writer::subscriptions) {
    ++user_control;
    return TrafficClass::user_control;
  }
  if (m.kind == Submessage::Kind::heartbeat) {
    ++counts.heartbeat;
    return TrafficClass::heartbeat;
  }
  if (m.kind == Submessage::Kind::gap) {
    ++counts.gap;
    return TrafficClass::heartbeat;
  }
  ++counts.acknack;
  return TrafficClass::acknack;
}

/// Counts a submessage on its way to the destination of `pair`, or from participant `pair` to the
/// group; says what it is for.
TrafficClass Sender::count(const Submessage& m, Number pair, bool to_group) {
  const bool later = counts_at_admission(run_);
  Counts of_no_interest;
  std::uint64_t control_of_no_interest = 0;
  Counts& counts = later ? of_no_interest : run_.counts;
  if (m.kind == Submessage::Kind::spdp) {
    ++(to_group ? counts.spdp_multicast : counts.spdp_unicast);
    return TrafficClass::spdp;
  }
  if (m.kind != Submessage::Kind::data || m.writer > writer::subscriptions) {
    return count_control(m, counts, later ? control_of_no_interest : run_.user_control);
  }
  auto& delivered = to_group ? delivered_to_group_[stride_ * m.participant + m.writer]
                             : delivered_[stride_ * pair + m.writer];
  const bool again = mark(delivered, m.sample);
  ++(again ? counts.repair_data : counts.initial_data);
  return again ? TrafficClass::repair_data : TrafficClass::initial_data;
}

void Sender::count_admitted(const model::Packet& packet) {
  run_.counts.initial_data += packet.initial_data;
  run_.counts.repair_data += packet.repair_data;
  for (const Submessage& m : *packet.submessages) {
    if (m.kind == Submessage::Kind::spdp) {
      ++(packet.to_group ? run_.counts.spdp_multicast : run_.counts.spdp_unicast);
    } else if (m.kind != Submessage::Kind::data || m.writer > writer::subscriptions) {
      count_control(m, run_.counts, run_.user_control);
    }
  }
}

}  // namespace stormproof::model::cyclone
