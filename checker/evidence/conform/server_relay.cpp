// Takes the submessages of each datagram together.
#include "checker/evidence/conform/server_relay.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "checker/evidence/conform/words.hpp"

namespace stormproof::conform::server {

namespace {

void collect(const Relation& relation, std::size_t index, std::vector<Passed>& all) {
  std::set<std::uint32_t> sent;
  std::optional<std::uint32_t> datagram;
  for (const Submessage& one : relation.sent) {
    // A HEARTBEAT belongs to what it is behind.
    const bool is_behind = one.heartbeat && datagram == one.datagram && !all.back().heartbeat;
    if (!is_behind) {
      Passed passed;
      passed.relation = index;
      passed.time_ns = one.time_ns;
      passed.event = one.event;
      passed.change = one.descriptor;
      passed.is_gap = !one.descriptor && !one.heartbeat;
      passed.gap = one.gap;
      if (one.descriptor) passed.is_first = sent.insert(*one.descriptor).second;
      all.push_back(std::move(passed));
    }
    datagram = one.datagram;
    if (!one.heartbeat) continue;
    all.back().heartbeat = one.heartbeat;
    all.back().heartbeat_event = one.event;
  }
}

}  // namespace

std::vector<Passed> passed_by(const WriterRelations& relay) {
  std::vector<Passed> all;
  for (std::size_t r = 0; r < relay.relations.size(); ++r) collect(*relay.relations[r], r, all);
  std::ranges::sort(all, {}, &Passed::event);
  return all;
}

Unexplained unexplained_in(const WriterRelations& relay, const Passed& one, std::size_t event,
                           Fault kind, std::string what, std::string nearest,
                           std::vector<Need> needs) {
  return conform::unexplained_in(*relay.relations[one.relation], event, kind, std::move(what),
                                 std::move(nearest), std::move(needs));
}

}  // namespace stormproof::conform::server
