// Who needs what, and when it was sent first.
#include "checker/evidence/capture/relayed_keys.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <tuple>

namespace stormproof::capture {

namespace {

/// From whom, to whom, about what.
using Key = std::tuple<GuidPrefix, GuidPrefix, Guid>;

std::map<Key, std::int64_t> first_sent(const Conversation& conversation, std::int64_t until_ns) {
  std::map<Key, std::int64_t> first;
  for (const Event& event : conversation.events) {
    if (event.time_ns > until_ns) break;
    const DataEvent* data = event.data();
    if (data == nullptr || event.traffic() != Traffic::sedp || !event.destination) continue;
    if (!data->endpoint || data->fragment > 1) continue;
    first.try_emplace({event.source, *event.destination, *data->endpoint}, event.time_ns);
  }
  return first;
}

bool counts(const Endpoint& endpoint, std::int64_t until_ns) {
  return !endpoint.is_gone && endpoint.first_ns <= until_ns;
}

class Needs {
 public:
  Needs(const Conversation& conversation, const Participant& server, Counting& counting)
      : topology_{conversation.topology},
        server_{server},
        counting_{counting},
        sent_{first_sent(conversation, counting.until_ns)} {
    for (const Participant& one : topology_.participants) {
      for (const auto& [guid, endpoint] : one.endpoints) {
        if (!counts(endpoint, counting.until_ns)) continue;
        who_has_[{endpoint.announced_by, endpoint.topic}].insert(&one);
      }
    }
  }

  void check() {
    for (const Participant& one : topology_.participants) {
      for (const auto& [guid, endpoint] : one.endpoints) {
        if (counts(endpoint, counting_.until_ns)) check(one, guid, endpoint);
      }
    }
    if (counting_.missing_count == 0) counting_.last_initial_ns = last_ns_;
  }

 private:
  void check(const Participant& owner, const Guid& guid, const Endpoint& endpoint) {
    const EntityId opposite = endpoint.announced_by == entity::publications_writer
                                  ? entity::subscriptions_writer
                                  : entity::publications_writer;
    bool is_needed = false;
    for (const Participant* one : who_has_[{opposite, endpoint.topic}]) {
      if (one == &owner) continue;
      is_needed = true;
      if (is_on_link(*one)) look_for({server_.prefix, one->prefix, guid}, owner, *one, endpoint);
    }
    if (is_needed && is_on_link(owner)) {
      look_for({owner.prefix, server_.prefix, guid}, owner, server_, endpoint);
    }
  }

  /// Whether what it and the server say to each other is on the link.
  [[nodiscard]] bool is_on_link(const Participant& one) const {
    return topology_.hosts == 1 || one.host != server_.host;
  }

  void look_for(const Key& key, const Participant& owner, const Participant& destination,
                const Endpoint& endpoint) {
    ++counting_.required;
    if (const auto found = sent_.find(key); found != sent_.end()) {
      last_ns_ = std::max(last_ns_.value_or(found->second), found->second);
      return;
    }
    ++counting_.missing_count;
    if (counting_.missing.size() == most_missing_listed) return;
    counting_.missing.push_back(
        {owner.prefix, destination.prefix, endpoint.announced_by, endpoint.sequence_number});
  }

  const Topology& topology_;
  const Participant& server_;
  Counting& counting_;
  std::map<Key, std::int64_t> sent_;
  std::map<std::pair<EntityId, std::string>, std::set<const Participant*>> who_has_;
  std::optional<std::int64_t> last_ns_;
};

}  // namespace

void check_relayed_keys(const Conversation& conversation, const Participant& server,
                        Counting& counting) {
  Needs{conversation, server, counting}.check();
}

}  // namespace stormproof::capture
