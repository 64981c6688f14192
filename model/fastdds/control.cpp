// Which control-only relations there are, and when a side of one opens.
#include "model/fastdds/control.hpp"

#include <algorithm>

#include "model/fastdds/protocol.hpp"

namespace stormproof::model::fastdds {

namespace {
Stream other(Stream s) { return s == Stream::pub ? Stream::sub : Stream::pub; }
}  // namespace

ControlRelations::ControlRelations(const Topology& topology, const Scenario& scenario)
    : topology_{topology} {
  for (std::uint32_t pair = 0; pair < topology.pair_count(); ++pair) {
    first_relation_.push_back(count());
    const Pair& p = topology.pair(pair);
    const bool ask = looks_up_types(dds_of(scenario, p.source)) &&
                     looks_up_types(dds_of(scenario, p.destination));
    lookups_.push_back(static_cast<std::uint8_t>(ask ? topic::lookups.size() : 0));
    std::uint32_t relations = lookups_.back();
    if (p.cross_host) relations += 1;  // a Discovery Server has no topics
    if (p.cross_host && !topology.is_server(p.source) && !topology.is_server(p.destination)) {
      relations +=
          topic::first_user - 1 +
          std::min(topology.descriptor_count(p.source, Stream::pub) - default_publications,
                   topology.descriptor_count(p.destination, Stream::sub) - default_subscriptions);
    }
    pairs_.resize(pairs_.size() + relations, pair);
  }
  first_relation_.push_back(count());
}

std::uint32_t ControlRelations::find(std::uint32_t pair, std::uint32_t t) const {
  if (fastdds::is_lookup(t)) {
    return lookups_[pair] > 0 ? first_lookup(pair) + (t - topic::lookups.front()) : topic::none;
  }
  const std::uint32_t relation = first_relation_[pair] + t;
  return relation < first_lookup(pair) ? relation : topic::none;
}

Packet ControlRelations::packet_of(PacketKind kind, std::uint32_t relation,
                                   std::int64_t bytes) const {
  Packet packet;
  packet.kind = kind;
  packet.pair = pairs_[relation];
  packet.detail = relation;
  packet.payload_bytes = static_cast<std::uint32_t>(bytes);
  return packet;
}

void Protocol::open(ControlSide side) {
  if (side.relation == topic::none) return;  // as lookups that one end does not know
  if (side.writer)
    run_rule<comp::Happens<control::ControlWriterOpens>>(*this, side.relation);
  else
    run_rule<comp::Happens<control::ControlReaderOpens>>(*this, side.relation);
}

/// j has recognised i; `pair` is (i, j): what is built in opens on j's side.
void Protocol::open_builtin(std::uint32_t pair) {
  const std::uint32_t back = run_.topology.pair(pair).reverse;
  if (run_.topology.pair(pair).cross_host) {
    open({control_.find(pair, topic::liveliness), false});
    open({control_.find(back, topic::liveliness), true});
  }
  for (const std::uint32_t t : topic::lookups) open({control_.find(pair, t), false});
  for (const std::uint32_t t : topic::lookups) open({control_.find(back, t), true});
}

/// Participant i has created descriptor d of stream s: what it has been notified of is the peer's
/// other side of the topic.
void Protocol::open_created(std::uint32_t i, Stream s, std::uint32_t d) {
  const std::uint32_t t = topic_of(s, d);
  if (t == topic::none) return;
  for (std::uint32_t pair = run_.topology.first_pair(i); pair < run_.topology.first_pair(i + 1);
       ++pair) {
    if (!run_.topology.pair(pair).cross_host) continue;
    const std::uint32_t reverse = run_.topology.pair(pair).reverse;
    const std::uint32_t relation = control_.find(s == Stream::pub ? pair : reverse, t);
    if (relation == topic::none || !is_notified(reverse, other(s), descriptor_on(t, other(s))))
      continue;
    open({relation, s == Stream::pub});
  }
}

/// The destination of `pair` has been notified of the source's descriptor d of stream s.
void Protocol::open_notified(std::uint32_t pair, Stream s, std::uint32_t d) {
  const std::uint32_t t = topic_of(s, d);
  if (t == topic::none) return;
  const Pair& p = run_.topology.pair(pair);
  const std::uint32_t relation = control_.find(s == Stream::pub ? pair : p.reverse, t);
  if (!is_created(p.destination, other(s), descriptor_on(t, other(s)))) return;
  open({relation, s != Stream::pub});
}

void Protocol::count_control(std::uint32_t relation) {
  const bool crosses = run_.topology.pair(control_.pair_of(relation)).cross_host;
  if (crosses && !counts_at_admission(run_)) ++run_.user_control;
}

void Protocol::send_control(PacketKind kind, std::uint32_t relation, bool initial,
                            std::uint32_t last_sample) {
  const bool acknack = kind == PacketKind::user_acknack;
  Packet packet =
      control_.packet_of(kind, relation, acknack ? acknack_bytes : heartbeat_to_one_bytes);
  packet.initial_acknack = initial;
  packet.port = control_.is_builtin(relation) ? 0 : 1;
  packet.set_samples(0, last_sample);
  count_control(relation);
  send(std::move(packet));
}

}  // namespace stormproof::model::fastdds
