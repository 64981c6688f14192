// Creation of endpoints over time, SPDP, and the matching that follows from recognising a
// participant. Unlike in the paper's model the unicast copies leave before the multicast, and
// same-host participants take part.
#include "model/fastdds/protocol.hpp"

namespace stormproof::model::fastdds {

void Protocol::create_endpoint(std::uint32_t i, std::uint32_t k) {
  const std::uint32_t user_publications =
      run_.topology.descriptor_count(i, Stream::pub) - default_publications;
  const auto [stream, d] = creation_order(k, user_publications);
  const std::uint32_t w = 2 * i + static_cast<std::uint32_t>(stream);
  writers_[w].created = d + 1;
  if (!writers_[w].readers.empty()) push(w, d);
  control_.created(i, stream, d);
}

void Protocol::send_spdp_to_known(std::uint32_t i) {
  for (std::uint32_t pair = run_.topology.first_pair(i); pair < run_.topology.first_pair(i + 1);
       ++pair) {
    if (known_[pair]) send_spdp_copy(pair);
  }
}

void Protocol::send_spdp_multicast(std::uint32_t i) {
  ++run_.counts.spdp_multicast;
  for (std::uint32_t pair = run_.topology.first_pair(i); pair < run_.topology.first_pair(i + 1);
       ++pair) {
    const Pair& p = run_.topology.pair(pair);
    if (p.cross_host) continue;
    network_.loop_back(packet_of(PacketKind::spdp_multicast, i, spdp_bytes), p.destination);
  }
  network_.emit(i, packet_of(PacketKind::spdp_multicast, i, spdp_bytes));
}

void Protocol::send_spdp_copy(std::uint32_t pair) {
  if (run_.topology.pair(pair).cross_host) ++run_.counts.spdp_unicast;
  send(packet_of(PacketKind::spdp_unicast, pair, spdp_bytes));
}

/// `pair` is (i, j): j has received i's announcement.
void Protocol::spdp_received(std::uint32_t pair) {
  const std::uint32_t reverse = run_.topology.pair(pair).reverse;
  if (known_[reverse]) return;
  known_[reverse] = true;
  resend(reverse);
  for (const Stream s : streams) {
    open_reader(2 * pair + static_cast<std::uint32_t>(s));
    match_reader(2 * reverse + static_cast<std::uint32_t>(s));
  }
  if (run_.topology.pair(pair).cross_host) control_.recognised(pair);
}

/// The writer side opens: existing descriptors wait until the reader asks for them.
void Protocol::match_reader(std::uint32_t relation) {
  Relation& r = relations_[relation];
  if (r.matched) return;
  r.matched = true;
  const std::uint32_t w = writer_of(relation);
  writers_[w].readers.push_back(relation);
  changes_.matched(relation, writers_[w].created);
  if (writers_[w].created > 0) heartbeats_.arm(w);
  send_heartbeat(relation);
}

}  // namespace stormproof::model::fastdds
