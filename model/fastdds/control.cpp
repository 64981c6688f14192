// Opening, HEARTBEATs and ACKNACKs of control-only relations.
#include "model/fastdds/control.hpp"

#include <algorithm>

namespace stormproof::model::fastdds {

namespace {

constexpr std::int64_t reply_delay_ns = 5'000'000;  // heartbeatResponseDelay of ordinary readers

Stream other(Stream s) { return s == Stream::pub ? Stream::sub : Stream::pub; }

}  // namespace

ControlTraffic::ControlTraffic(RunState& run, Network& network, const Discovered& discovered)
    : run_{run},
      network_{network},
      discovered_{discovered},
      initial_attempts_{run, MachineRef::Kind::control_relation, EventKind::control_initial_due} {
  for (std::uint32_t pair = 0; pair < run.topology.pair_count(); ++pair) {
    first_relation_.push_back(static_cast<std::uint32_t>(relations_.size()));
    const Pair& p = run.topology.pair(pair);
    if (!p.cross_host) continue;
    const std::uint32_t publications =
        run.topology.descriptor_count(p.source, Stream::pub) - default_publications;
    const std::uint32_t subscriptions =
        run.topology.descriptor_count(p.destination, Stream::sub) - default_subscriptions;
    Relation relation;
    relation.pair = pair;
    relations_.resize(relations_.size() + topic::first_user + std::min(publications, subscriptions),
                      relation);
  }
  first_relation_.push_back(static_cast<std::uint32_t>(relations_.size()));
}

bool ControlTraffic::exists(std::uint32_t pair, std::uint32_t t) const {
  return first_relation_[pair] + t < first_relation_[pair + 1];
}

void ControlTraffic::recognised(std::uint32_t pair) {
  open_reader(relation_of(pair, topic::liveliness));
  open_writer(relation_of(run_.topology.pair(pair).reverse, topic::liveliness));
}

void ControlTraffic::created(std::uint32_t i, Stream s, std::uint32_t d) {
  const std::uint32_t t = topic_of(s, d);
  if (t == topic::none) return;
  for (std::uint32_t pair = run_.topology.first_pair(i); pair < run_.topology.first_pair(i + 1);
       ++pair) {
    const std::uint32_t reverse = run_.topology.pair(pair).reverse;
    const std::uint32_t relation_pair = s == Stream::pub ? pair : reverse;
    if (!run_.topology.pair(pair).cross_host || !exists(relation_pair, t)) continue;
    // What i has been notified of is the peer's other side of the topic.
    if (!discovered_.is_notified(reverse, other(s), descriptor_on(t, other(s)))) continue;
    const std::uint32_t relation = relation_of(relation_pair, t);
    if (s == Stream::pub)
      open_writer(relation);
    else
      open_reader(relation);
  }
}

void ControlTraffic::notified(std::uint32_t pair, Stream s, std::uint32_t d) {
  const std::uint32_t t = topic_of(s, d);
  if (t == topic::none) return;
  const Pair& p = run_.topology.pair(pair);
  const std::uint32_t relation_pair = s == Stream::pub ? pair : p.reverse;
  if (!exists(relation_pair, t)) return;
  if (!discovered_.is_created(p.destination, other(s), descriptor_on(t, other(s)))) return;
  const std::uint32_t relation = relation_of(relation_pair, t);
  if (s == Stream::pub)
    open_reader(relation);
  else
    open_writer(relation);
}

void ControlTraffic::open_writer(std::uint32_t relation) {
  const auto output = writer_driver_.step<fsm::control_relation::Opened>(
      run_, relations_[relation].writer, {}, relation);
  if (output.send_heartbeat) emit_heartbeat(relation);
}

void ControlTraffic::open_reader(std::uint32_t relation) {
  const auto output = reader_driver_.step<fsm::control_relation::Opened>(
      run_, relations_[relation].reader, {}, relation);
  if (output.start_initial) initial_attempts_.open(relations_[relation].initial, relation);
}

void ControlTraffic::received(const Packet& packet) {
  const std::uint32_t relation = packet.detail;
  Relation& r = relations_[relation];
  if (packet.kind == PacketKind::user_acknack) {
    if (!packet.initial_acknack) return;  // it acknowledges data that are not modelled
    const auto output = writer_driver_.step<fsm::control_relation::InitialAckNackReceived>(
        run_, r.writer, {}, relation);
    if (output.send_heartbeat) emit_heartbeat(relation);
    return;
  }
  const auto output =
      reader_driver_.step<fsm::control_relation::HeartbeatReceived>(run_, r.reader, {}, relation);
  if (!output.reply) return;
  r.heartbeat_seen = true;
  const auto timer = reply_driver_.step<fsm::single_shot::Requested>(
      run_, r.reply, {.now = run_.now.count(), .delay = reply_delay_ns}, relation);
  if (timer.schedule) {
    run_.schedule(Nanoseconds{timer.next_at}, EventKind::control_reply_due, relation);
  }
}

void ControlTraffic::handle(const Event& event) {
  if (event.kind == EventKind::control_initial_due) {
    Relation& r = relations_[event.subject];
    initial_attempts_.attempt(r.initial, r.heartbeat_seen, event.subject,
                              [&] { emit_acknack(event.subject, true); });
    return;
  }
  const auto timer = reply_driver_.step<fsm::single_shot::Due>(
      run_, relations_[event.subject].reply, {.now = run_.now.count(), .delay = 0}, event.subject);
  if (timer.fire) emit_acknack(event.subject, false);
}

void ControlTraffic::emit_heartbeat(std::uint32_t relation) {
  ++run_.user_control;
  Packet packet;
  packet.kind = PacketKind::user_heartbeat;
  packet.pair = relations_[relation].pair;
  packet.detail = relation;
  packet.payload_bytes = static_cast<std::uint32_t>(heartbeat_to_one_bytes);
  network_.emit(run_.topology.pair(packet.pair).source, std::move(packet));
}

void ControlTraffic::emit_acknack(std::uint32_t relation, bool initial) {
  ++run_.user_control;
  Packet packet;
  packet.kind = PacketKind::user_acknack;
  packet.pair = relations_[relation].pair;
  packet.detail = relation;
  packet.initial_acknack = initial;
  packet.payload_bytes = static_cast<std::uint32_t>(acknack_bytes);
  network_.emit(run_.topology.pair(packet.pair).destination, std::move(packet));
}

}  // namespace stormproof::model::fastdds
