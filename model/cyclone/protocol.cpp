// From events and packets to rules; what arrives.
#include "model/cyclone/protocol.hpp"

#include <bit>

#include "model/cyclone/living_protocol.hpp"
#include "model/engine/endpoint_creations.hpp"

namespace stormproof::model::cyclone {

template <class Self, class Composition_, class Columns_, class Steps>
ProtocolOf<Self, Composition_, Columns_, Steps>::ProtocolOf(RunState& run, Network& network)
    : Stored{run}, ThreadSteps{run}, sender_{run, network, *this} {}

template <class Self, class Composition_, class Columns_, class Steps>
void ProtocolOf<Self, Composition_, Columns_, Steps>::start() {
  for (Number i = 0; i < this->run_.topology.participant_count(); ++i) {
    const Nanoseconds begin = this->run_.scenario.deployment.participants[i].start;
    this->run_.schedule(begin, EventKind::participant_start, i);
    schedule_creations(this->run_, i, begin);
  }
}

template <class Self, class Composition_, class Columns_, class Steps>
void ProtocolOf<Self, Composition_, Columns_, Steps>::handle(const Event& event) {
  const Number i = event.subject;
  if (event.kind == EventKind::participant_start) {
    run<comp::Happens<rules::Starts>>(i);
  } else if (event.kind == EventKind::endpoint_creation) {
    this->create(i, creation_of(this->run_.topology, i, event.detail));
  } else {
    run_due(static_cast<Self&>(*this), event);
  }
}

template <class Self, class Composition_, class Columns_, class Steps>
std::vector<std::uint32_t> ProtocolOf<Self, Composition_, Columns_, Steps>::receivers(
    const model::Packet& packet) const {
  if (!packet.multicast()) return {this->run_.topology.pair(packet.pair).destination};
  std::vector<Number> receivers;
  for (Number p = this->run_.topology.first_pair(packet.pair);
       p < this->run_.topology.first_pair(packet.pair + 1); ++p) {
    const Pair& pair = this->run_.topology.pair(p);
    if (pair.cross_host) receivers.push_back(pair.destination);
  }
  return receivers;
}

template <class Self, class Composition_, class Columns_, class Steps>
std::optional<Nanoseconds> ProtocolOf<Self, Composition_, Columns_, Steps>::receives_later(
    Number receiver) const {
  const model::Participant& p = this->run_.scenario.deployment.participants[receiver];
  const Nanoseconds ready = p.ready.value_or(p.start);
  if (this->run_.now < p.open.value_or(p.start) || this->run_.now >= ready) return {};
  return ready;
}

template <class Self, class Composition_, class Columns_, class Steps>
void ProtocolOf<Self, Composition_, Columns_, Steps>::received(const model::Packet& packet,
                                                               Number receiver) {
  this->take_in(packet, receiver);
}

template <class Self, class Composition_, class Columns_, class Steps>
void ProtocolOf<Self, Composition_, Columns_, Steps>::send_copy(Number i, Number to) {
  sender_.send(i, to, packet_of(i, to));
}

template <class Self, class Composition_, class Columns_, class Steps>
model::Packet ProtocolOf<Self, Composition_, Columns_, Steps>::packet_of(Number i,
                                                                         Number to) const {
  model::Packet packet;
  packet.kind = PacketKind::rtps_message;
  packet.to_group = to == group;
  packet.pair = packet.to_group ? i : this->run_.topology.pair_between(i, to);
  packet.payload_bytes = static_cast<Number>(this->threads_[i].bytes);
  packet.submessages = this->threads_[i].contents;
  return packet;
}

/// The reader has these of word k now, and perhaps they complete the run.
template <class Self, class Composition_, class Columns_, class Steps>
void ProtocolOf<Self, Composition_, Columns_, Steps>::take(Number r, Number k,
                                                           std::uint64_t received) {
  const std::uint64_t fresh = this->required(r, k, received);
  Stored::assign_word(comp::X{}, r, k, Stored::word(comp::X{}, r, k) | received);
  if (fresh == 0) return;
  const auto count = static_cast<std::uint64_t>(std::popcount(fresh));
  this->run_.useful_deliveries += count;
  this->run_.missing -= count;
  if (this->run_.missing > 0) return;
  this->run_.last_delivered = {ParticipantId{this->ends_of(r).source},
                               ParticipantId{this->ends_of(r).destination},
                               stream_of(r % this->stride_),
                               DescriptorId{64 * k + static_cast<Number>(std::countr_zero(fresh))}};
}

template <class Self, class Composition_, class Columns_, class Steps>
std::vector<MissingDescriptor> ProtocolOf<Self, Composition_, Columns_, Steps>::missing(
    std::size_t limit) {
  std::vector<MissingDescriptor> list;
  for (Number pair = 0; pair < this->run_.topology.pair_count(); ++pair) {
    const Pair& p = this->run_.topology.pair(pair);
    if (!p.cross_host) continue;
    for (const Stream s : streams) {
      for (Number d = 0; d < this->run_.topology.descriptor_count(p.source, s); ++d) {
        if (list.size() == limit) return list;
        if (this->has(comp::X{}, this->stride_ * pair + slot_of(s), d)) continue;
        list.push_back({ParticipantId{p.source}, ParticipantId{p.destination}, s, DescriptorId{d}});
      }
    }
  }
  return list;
}

template class ProtocolOf<Protocol, rules::Cyclone, Columns, ThreadSteps<Protocol>>;
template class ProtocolOf<LivingProtocol, rules::CycloneLiving, LivingColumns,
                          LivingSteps<LivingProtocol>>;

}  // namespace stormproof::model::cyclone
