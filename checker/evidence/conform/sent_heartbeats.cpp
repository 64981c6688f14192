// Groups the copies of each HEARTBEAT by its count.
#include "checker/evidence/conform/sent_heartbeats.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace stormproof::conform {

namespace {

std::set<std::uint32_t> datagrams_with_data(const Relation& relation) {
  std::set<std::uint32_t> datagrams;
  for (const Submessage& one : relation.sent) {
    if (one.descriptor) datagrams.insert(one.datagram);
  }
  return datagrams;
}

void add_copy(SentHeartbeat& one, std::size_t relation, const Submessage& copy,
              bool is_behind_data) {
  one.says_one_thing = one.says_one_thing &&
                       (one.copies == 0 || (one.heartbeat.announced == copy.heartbeat->announced &&
                                            one.heartbeat.first == copy.heartbeat->first));
  if (one.copies++ == 0 || copy.time_ns < one.time_ns) {
    one.time_ns = copy.time_ns;
    one.event = copy.event;
    one.heartbeat = *copy.heartbeat;
    one.relation = relation;
  }
  one.is_behind_data = one.is_behind_data || is_behind_data;
  one.is_directed = copy.heartbeat->is_directed && !one.is_behind_data && one.copies == 1;
  one.is_multicast = one.is_multicast || copy.is_multicast;
  one.events.insert(copy.event);
  if (!copy.is_multicast) one.receivers.insert(relation);
}

}  // namespace

SentHeartbeats sent_heartbeats(const WriterRelations& writer) {
  SentHeartbeats sent;
  std::map<std::uint32_t, SentHeartbeat> by_count;
  for (std::size_t r = 0; r < writer.relations.size(); ++r) {
    const auto with_data = datagrams_with_data(*writer.relations[r]);
    std::set<std::uint32_t> counts;
    for (const Submessage& one : writer.relations[r]->sent) {
      if (!one.heartbeat) continue;
      const bool is_behind_data = with_data.count(one.datagram) > 0;
      if (!counts.insert(one.heartbeat->count).second &&
          (!sent.repeated || one.event < sent.repeated->event)) {
        sent.repeated.emplace();
        add_copy(*sent.repeated, r, one, is_behind_data);
      }
      add_copy(by_count[one.heartbeat->count], r, one, is_behind_data);
    }
  }
  for (auto& [count, one] : by_count) sent.all.push_back(one);
  std::stable_sort(sent.all.begin(), sent.all.end(),
                   [](const SentHeartbeat& a, const SentHeartbeat& b) {
                     return std::pair{a.time_ns, a.event} < std::pair{b.time_ns, b.event};
                   });
  return sent;
}

}  // namespace stormproof::conform
