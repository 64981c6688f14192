// From events and packets to rules; what arrives.
#include "model/cyclone/protocol.hpp"

#include <bit>

#include "model/engine/endpoint_creations.hpp"

namespace stormproof::model::cyclone {

Protocol::Protocol(RunState& run, Network& network)
    : Stored{run},
      ThreadSteps{run},
      network_{network},
      delivered_to_group_(std::size_t{stride_} * run.topology.participant_count()),
      delivered_(std::size_t{stride_} * run.topology.pair_count()) {
  begin_liveliness();
  for (Number w = 0; w < delivered_to_group_.size(); ++w) {
    delivered_to_group_[w].resize(words_for(samples_of(w)));
  }
  for (Number r = 0; r < delivered_.size(); ++r) {
    delivered_[r].resize(words_for(samples_of(writer_of(r))));
  }
}

void Protocol::start() {
  for (Number i = 0; i < run_.topology.participant_count(); ++i) {
    const Nanoseconds begin = run_.scenario.deployment.participants[i].start;
    run_.schedule(begin, EventKind::participant_start, i);
    schedule_creations(run_, i, begin);
  }
}

void Protocol::handle(const Event& event) {
  const Number i = event.subject;
  if (event.kind == EventKind::participant_start) {
    run<comp::Happens<rules::Starts>>(i);
  } else if (event.kind == EventKind::endpoint_creation) {
    create(i, creation_of(run_.topology, i, event.detail));
  } else {
    run_due(*this, event);
  }
}

std::vector<Protocol::Number> Protocol::receivers(const model::Packet& packet) const {
  if (!packet.multicast()) return {run_.topology.pair(packet.pair).destination};
  std::vector<Number> receivers;
  for (Number p = run_.topology.first_pair(packet.pair);
       p < run_.topology.first_pair(packet.pair + 1); ++p) {
    const Pair& pair = run_.topology.pair(p);
    if (pair.cross_host) receivers.push_back(pair.destination);
  }
  return receivers;
}

std::optional<Nanoseconds> Protocol::receives_later(Number receiver) const {
  const model::Participant& p = run_.scenario.deployment.participants[receiver];
  const Nanoseconds ready = p.ready.value_or(p.start);
  if (run_.now < p.open.value_or(p.start) || run_.now >= ready) return {};
  return ready;
}

void Protocol::received(const model::Packet& packet, Number receiver) { take_in(packet, receiver); }

/// The reader has these of word k now, and perhaps they complete the run.
void Protocol::take(Number r, Number k, std::uint64_t received) {
  const std::uint64_t fresh = required(r, k, received);
  Stored::assign_word(comp::X{}, r, k, word(comp::X{}, r, k) | received);
  if (fresh == 0) return;
  const auto count = static_cast<std::uint64_t>(std::popcount(fresh));
  run_.useful_deliveries += count;
  run_.missing -= count;
  if (run_.missing > 0) return;
  run_.last_delivered = {ParticipantId{ends_of(r).source}, ParticipantId{ends_of(r).destination},
                         stream_of(r % stride_),
                         DescriptorId{64 * k + static_cast<Number>(std::countr_zero(fresh))}};
}

std::vector<MissingDescriptor> Protocol::missing(std::size_t limit) {
  std::vector<MissingDescriptor> list;
  for (Number pair = 0; pair < run_.topology.pair_count(); ++pair) {
    const Pair& p = run_.topology.pair(pair);
    if (!p.cross_host) continue;
    for (const Stream s : streams) {
      for (Number d = 0; d < run_.topology.descriptor_count(p.source, s); ++d) {
        if (list.size() == limit) return list;
        if (has(comp::X{}, stride_ * pair + slot_of(s), d)) continue;
        list.push_back({ParticipantId{p.source}, ParticipantId{p.destination}, s, DescriptorId{d}});
      }
    }
  }
  return list;
}

}  // namespace stormproof::model::cyclone
