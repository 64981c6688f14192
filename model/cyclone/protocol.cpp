// From events and submessages to rules; which user topics match when; what arrives.
#include "model/cyclone/protocol.hpp"

#include <algorithm>
#include <bit>

namespace stormproof::model::cyclone {

namespace {
Stream other(Stream s) { return s == Stream::pub ? Stream::sub : Stream::pub; }
Stream stream_of(std::uint32_t slot) {
  return slot == writer::publications ? Stream::pub : Stream::sub;
}
std::uint32_t slot_of(Stream s) {
  return s == Stream::pub ? writer::publications : writer::subscriptions;
}
}  // namespace

Protocol::Protocol(RunState& run, Network& network)
    : Stored{run},
      network_{network},
      sedp_{run.scenario.dds.sedp},
      multicast_{run.scenario.dds.allow_multicast == AllowMulticast::always},
      stride_{writers_per_participant(run.topology)},
      writers_(std::size_t{stride_} * run.topology.participant_count()),
      delivered_(std::size_t{stride_} * run.topology.pair_count()) {
  for (Number i = 0; i < run.topology.participant_count(); ++i) {
    participants_.emplace_back(sedp_);
    const Number liveliness = stride_ * i + writer::liveliness;
    set_first<rules::Exists>(liveliness, 1);
    set_first<rules::Sent>(liveliness, 1);
  }
  for (Number w = 0; w < writers_.size(); ++w)
    writers_[w].delivered.resize(words_for(samples_of(w)));
  for (Number r = 0; r < delivered_.size(); ++r)
    delivered_[r].resize(words_for(samples_of(writer_of(r))));
}

Protocol::Number Protocol::samples_of(Number w) const {
  const Number slot = w % stride_;
  if (slot == writer::liveliness) return 1;
  if (slot > writer::liveliness) return 0;
  return run_.topology.descriptor_count(w / stride_, stream_of(slot));
}

void Protocol::start() {
  for (Number i = 0; i < run_.topology.participant_count(); ++i) {
    const model::Participant& participant = run_.scenario.deployment.participants[i];
    const std::int64_t begin = participant.start.count();
    const std::int64_t span = participant.endpoints_done.count() - begin;
    const std::int64_t endpoints = run_.topology.descriptor_count(i, Stream::pub) +
                                   run_.topology.descriptor_count(i, Stream::sub);
    run_.schedule(participant.start, EventKind::participant_start, i);
    for (std::int64_t k = 0; k < endpoints; ++k) {
      run_.schedule(Nanoseconds{begin + span * (k + 1) / endpoints}, EventKind::endpoint_creation,
                    i, static_cast<Number>(k));
    }
  }
}

void Protocol::handle(const Event& event) {
  const Number i = event.subject;
  if (event.kind == EventKind::participant_start) {
    run_rule<comp::Happens<rules::Starts>>(*this, i);
  } else if (event.kind == EventKind::endpoint_creation) {
    const Number publications =
        run_.topology.descriptor_count(i, Stream::pub) - default_publications;
    const auto [stream, d] = creation_order(event.detail, publications);
    run_rule<comp::Happens<rules::Created>>(*this, stride_ * i + slot_of(stream), nullptr, d);
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

void Protocol::received(const model::Packet& packet, Number receiver) {
  const model::Participant& p = run_.scenario.deployment.participants[receiver];
  if (run_.now < p.open.value_or(p.start)) return;
  const Number sender = packet.multicast() ? packet.pair : run_.topology.pair(packet.pair).source;
  for (const Submessage& m : *packet.submessages) {
    receive(m, sender, receiver);
    if (run_.ends_now()) return;
  }
  run_rule<comp::Happens<rules::PacketEnds>>(*this, receiver);
}

void Protocol::receive(const Submessage& m, Number sender, Number receiver) {
  const Number pair = m.kind == Submessage::Kind::acknack
                          ? run_.topology.pair_between(receiver, sender)
                          : run_.topology.pair_between(sender, receiver);
  const Number relation = stride_ * pair + m.writer;
  switch (m.kind) {
    case Submessage::Kind::spdp:
      run_rule<comp::Received<rules::Spdp>>(*this, pair, &m);
      break;
    case Submessage::Kind::data:
      run_rule<comp::Received<rules::Data>>(*this, relation, &m);
      break;
    case Submessage::Kind::heartbeat:
      run_rule<comp::Received<rules::Heartbeat>>(*this, relation, &m);
      break;
    case Submessage::Kind::acknack:
      run_rule<comp::Received<rules::AckNack>>(*this, relation, &m);
      break;
  }
}

void Protocol::match(Number r) {
  Writer& writer = writers_[writer_of(r)];
  writer.readers.insert(std::ranges::lower_bound(writer.readers, r), r);
  ++writer.version;
}

/// The reader has these of word k now, and perhaps they complete the run.
void Protocol::take(Number r, Number k, std::uint64_t received) {
  const std::uint64_t before = word(comp::X{}, r, k);
  const std::uint64_t fresh = received & ~before;
  Stored::assign_word(comp::X{}, r, k, before | fresh);
  if (fresh == 0 || r % stride_ > writer::subscriptions || !ends(r).cross_host) return;
  const auto count = static_cast<std::uint64_t>(std::popcount(fresh));
  run_.useful_deliveries += count;
  run_.missing -= count;
  if (run_.missing > 0) return;
  run_.last_delivered = {ParticipantId{ends(r).source}, ParticipantId{ends(r).destination},
                         stream_of(r % stride_),
                         DescriptorId{64 * k + static_cast<Number>(std::countr_zero(fresh))}};
}

/// Participant i has created a descriptor: what it has been notified of is the peers' other side of
/// the topic.
void Protocol::open_created(Number w, Number sample) {
  const Stream s = stream_of(w % stride_);
  const Number topic = topic_writer(s, sample);
  if (topic == writer::none) return;
  const Number i = w / stride_;
  for (Number pair = run_.topology.first_pair(i); pair < run_.topology.first_pair(i + 1); ++pair) {
    const Number reverse = run_.topology.pair(pair).reverse;
    const Number told = stride_ * reverse + slot_of(other(s));
    if (!has(rules::Notified{}, told, descriptor_of(topic, other(s)))) continue;
    if (s == Stream::pub) {
      run_rule<comp::Happens<rules::WriterOpens>>(*this, stride_ * pair + topic);
    } else {
      run_rule<comp::Happens<comp::ReaderOpens>>(*this, stride_ * reverse + topic);
    }
  }
}

/// The reader of the relation has been notified of a descriptor.
void Protocol::open_notified(Number r, Number sample) {
  if (r % stride_ > writer::subscriptions) return;
  const Stream s = stream_of(r % stride_);
  const Number topic = topic_writer(s, sample);
  if (topic == writer::none) return;
  const Number own = stride_ * ends(r).destination + slot_of(other(s));
  if (!has(rules::Exists{}, own, descriptor_of(topic, other(s)))) return;
  if (s == Stream::pub) {
    run_rule<comp::Happens<comp::ReaderOpens>>(*this, stride_ * (r / stride_) + topic);
  } else {
    run_rule<comp::Happens<rules::WriterOpens>>(*this, stride_ * ends(r).reverse + topic);
  }
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
