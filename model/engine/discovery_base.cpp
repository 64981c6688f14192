// The cycle of the adaptive policy, and what packets have in common.
#include "model/engine/discovery_base.hpp"

#include "fsm/adaptive_period.hpp"

namespace stormproof::model {

DiscoveryBase::DiscoveryBase(RunState& run, Network& network)
    : Stored{run}, network_{network}, cycles_(2 * std::size_t{run.topology.participant_count()}) {
  for (std::uint32_t relation = 0; relation < run.topology.relation_count(); ++relation) {
    const std::uint32_t count = run.topology.descriptor_count(relation);
    at<Lacking>(relation) = count;
    using Reader = fsm::Reflect<fsm::DiscoveryReader>;
    if (count == 0) at<comp::Reader>(relation) = Reader::id<fsm::discovery_reader::EarlyComplete>;
  }
}

void DiscoveryBase::plan_batches(std::uint32_t w, std::int64_t stretched) {
  Cycle& clock = cycles_[w];
  clock.batches.clear();
  clock.next_batch = 0;
  const AdaptiveProfile& policy = run_.profiles.of(w / 2).sedp.adaptive;
  const fsm::AdaptiveCycle<fsm::Plain> cycle{.contacted = clock.contacted,
                                             .responded = clock.responded,
                                             .epsilon_num = policy.epsilon_numerator,
                                             .epsilon_den = policy.epsilon_denominator};
  const auto size = static_cast<std::size_t>(fsm::batch_size<fsm::Plain>(cycle));
  for (const std::uint32_t relation : open_relations(w)) {
    if (!at<comp::Contacted>(relation) || at<comp::Responded>(relation)) continue;
    if (clock.batches.empty() || clock.batches.back().size() == size) clock.batches.emplace_back();
    clock.batches.back().push_back(relation);
  }
  const std::int64_t rest = stretched - at<comp::CyclePeriod>(w);
  const auto count = static_cast<std::int64_t>(clock.batches.size());
  for (std::int64_t k = 0; k < count; ++k) {
    schedule(comp::BatchDue{}, w, now() + rest * k / count);
  }
}

std::vector<std::uint32_t> DiscoveryBase::next_batch(std::uint32_t w) {
  Cycle& clock = cycles_[w];
  if (clock.next_batch == clock.batches.size()) return {};  // the event was scheduled twice
  return clock.batches[clock.next_batch++];
}

void DiscoveryBase::note_last_delivery(std::uint32_t relation, std::uint32_t descriptor) {
  run_.last_delivered = {ParticipantId{ends(relation).source},
                         ParticipantId{ends(relation).destination}, stream_of(relation),
                         DescriptorId{descriptor}};
}

Packet DiscoveryBase::packet_of(PacketKind kind, std::uint32_t pair, std::int64_t payload_bytes) {
  Packet packet;
  packet.kind = kind;
  packet.pair = pair;
  packet.payload_bytes = static_cast<std::uint32_t>(payload_bytes);
  return packet;
}

Packet DiscoveryBase::packet_on(PacketKind kind, std::uint32_t relation,
                                std::int64_t payload_bytes) {
  Packet packet = packet_of(kind, relation / 2, payload_bytes);
  packet.stream = stream_of(relation);
  return packet;
}

}  // namespace stormproof::model
