// The routine of a Discovery Server.
#include "model/fastdds/database.hpp"

#include <algorithm>
#include <utility>

#include "model/fastdds/endpoints.hpp"

namespace stormproof::model::fastdds {

namespace {
/// Request and reply topics of a node's parameter services, which nobody else has.
constexpr std::uint32_t own_publications = default_publications - 3;
constexpr std::uint32_t own_subscriptions = default_subscriptions - 2;
constexpr std::uint32_t rosout_publication = 1;
}  // namespace

Database::Database(const Topology& topology, std::uint32_t server, Discovery discovery,
                   const ServerProfile& profile)
    : discovery_{discovery},
      profile_{profile},
      server_{server},
      first_server_{topology.first_server()},
      participants_{topology.participant_count()},
      contents_(topology.participant_count()),
      standing_(topology.participant_count()),
      is_direct_(topology.participant_count()) {
  for (std::uint32_t i = 0; i < participants_; ++i) contents_[i] = {i, true, {}, 0};
  for (std::uint32_t i = 0; i < topology.first_server(); ++i) {
    for (const Stream s : streams) {
      first_.push_back(static_cast<Item>(contents_.size()));
      const std::uint32_t count = topology.descriptor_count(i, s);
      for (std::uint32_t d = 0; d < count; ++d) {
        contents_.push_back({i, false, s, d});
        const std::uint32_t topic = topic_of(s, d);
        if (topic == topic::none) continue;
        shared_topics_ = std::max(shared_topics_, topic - topic::ros_discovery_info + 1);
      }
    }
  }
  topics_.resize(shared_topics_ + 1 +
                 topology.first_server() * (own_publications + own_subscriptions));
  marked_.resize(contents_.size() * participants_);
  noted_.resize(marked_.size());
  waiting_.resize(marked_.size());
  told_.resize(marked_.size());
  listed_.resize(contents_.size());
  known_.resize(contents_.size());
}

/// Shared topics, then rosout, then those that only one participant has.
std::uint32_t Database::topic_of_item(const Contents& item) const {
  const std::uint32_t shared = topic_of(item.stream, item.descriptor);
  if (shared != topic::none) return shared - topic::ros_discovery_info;
  if (item.stream == Stream::pub && item.descriptor == rosout_publication) return shared_topics_;
  const std::uint32_t first =
      shared_topics_ + 1 + item.participant * (own_publications + own_subscriptions);
  if (item.stream == Stream::pub) return first + item.descriptor - rosout_publication - 1;
  return first + own_publications + item.descriptor - 1;
}

bool Database::relevant(Item item, std::uint32_t j) const {
  const Contents& c = contents_[item];
  if (c.participant == server_) return true;
  if (!marked_[at(item, j)] || noted_[at(item, j)]) return false;
  const std::size_t announced = at(announcement(c.participant), j);
  return c.is_announcement || (marked_[announced] && noted_[announced]);
}

bool Database::tell(Item item, std::uint32_t j) {
  const bool before = told_[at(item, j)];
  told_[at(item, j)] = true;
  return !before;
}

void Database::tell_again(std::uint32_t i) {
  for (Item item = 0; item < contents_.size(); ++item) {
    told_[at(item, i)] = false;
    if (contents_[item].participant != i) continue;
    for (std::uint32_t j = 0; j < participants_; ++j) told_[at(item, j)] = false;
  }
}

void Database::mark(Item item, std::uint32_t j) {
  marked_[at(item, j)] = true;
  marked_[at(announcement(contents_[item].participant), j)] = true;
}

void Database::soil(std::uint32_t topic) {
  if (!std::exchange(topics_[topic].dirty, true)) dirty_.push_back(topic);
}

Database::Lists Database::update() {
  Lists lists;
  std::fill(listed_.begin(), listed_.end(), false);
  take_participants(lists);
  take_descriptors();
  const std::vector<std::uint32_t> dirty = std::exchange(dirty_, {});
  for (const std::uint32_t topic : dirty) topics_[topic].dirty = false;
  for (const std::uint32_t topic : dirty) {
    if (check_topic(lists, topics_[topic])) soil(topic);
  }
  if (std::exchange(news_, 0) == 0) lists.announcements.clear();
  return lists;
}

void Database::take_participants(Lists& lists) {
  for (const auto [i, leaves] : std::exchange(waiting_ones_, {})) {
    leaves ? take_leave(lists, i) : take_in(lists, i);
  }
}

/// Whose goodbye is still being told is dropped, or withdraws it.
void Database::take_in(Lists& lists, std::uint32_t i) {
  if (is_gone(i)) {
    if (profile_.rejoin == Rejoin::dropped) return;
    withdraw(lists, i);
  }
  const bool was_there = std::exchange(standing_[i], Standing::there) == Standing::there;
  if (was_there && !is_direct(i)) return;
  ++news_;
  all_noted = false;
  if (!is_direct(i)) return;
  if (discovery_ == Discovery::super_client || i >= first_server_) {
    take_in_super_client(lists, i);
  } else if (was_there) {
    tell_what_matches(i);
  }
}

/// It is told everything, and its own announcement is told to it again.
void Database::take_in_super_client(Lists& lists, std::uint32_t i) {
  for (std::uint32_t topic = 0; topic < topics_.size(); ++topic) {
    const Topic& t = topics_[topic];
    for (const auto* items : {&t.publications, &t.subscriptions}) {
      for (const Item item : *items) {
        if (contents_[item].participant != i) mark(item, i);
      }
    }
    if (!t.publications.empty() || !t.subscriptions.empty()) soil(topic);
  }
  super_clients_.push_back(i);
  const Item own = announcement(server_);
  if (!listed_[own]) {
    listed_[own] = true;
    lists.announcements.insert(lists.announcements.begin(), own);
  }
}

/// Its descriptors were here before it was.
void Database::tell_what_matches(std::uint32_t i) {
  for (std::uint32_t topic = 0; topic < topics_.size(); ++topic) {
    const Topic& t = topics_[topic];
    const auto tell_opposites = [&](const auto& own, const auto& opposites) {
      const auto is_own = [&](Item item) { return contents_[item].participant == i; };
      if (std::ranges::none_of(own, is_own)) return;
      for (const Item opposite : opposites) {
        if (!is_own(opposite)) mark(opposite, i);
      }
      soil(topic);
    };
    tell_opposites(t.publications, t.subscriptions);
    tell_opposites(t.subscriptions, t.publications);
  }
}

void Database::leave(std::uint32_t i) {
  is_direct_[i] = false;
  waiting_ones_.push_back({i, true});
  for (Item item = 0; item < contents_.size(); ++item) {
    if (contents_[item].participant == i) known_[item] = false;
  }
}

bool Database::arrive(Item item) {
  if (known_[item]) return false;
  known_[item] = true;
  arrived_.push_back(item);
  return true;
}

void Database::hear_of(std::uint32_t i, std::uint32_t other) {
  has(other, announcement(i));
  if (!is_direct(i)) waiting_ones_.push_back({i, false});
}

void Database::has(std::uint32_t other, Item item) {
  mark(item, other);
  noted_[at(item, other)] = true;
  noted_[at(announcement(contents_[item].participant), other)] = true;
}

/// Its descriptors leave, nobody has to tell it anything any more, and its announcement becomes a
/// goodbye for those for whom that was.
void Database::take_leave(Lists& lists, std::uint32_t i) {
  if (!is_in(i)) return;
  standing_[i] = Standing::gone;
  std::erase(super_clients_, i);
  for (Item item = 0; item < contents_.size(); ++item) {
    const Contents& c = contents_[item];
    clear(item, i);
    if (c.participant != i || c.is_announcement) continue;
    clear(item);
    Topic& topic = topics_[topic_of_item(c)];
    std::erase(c.stream == Stream::pub ? topic.publications : topic.subscriptions, item);
    lists.leaving.push_back(item);
  }
  const Item own = announcement(i);
  for (std::uint32_t j = 0; j < participants_; ++j) {
    noted_[at(own, j)] = false;
    waiting_[at(own, j)] = false;
  }
  lists.goodbyes.push_back(own);
}

void Database::withdraw(Lists& lists, std::uint32_t i) {
  clear(announcement(i));
  if (std::erase(lists.goodbyes, announcement(i)) == 0) lists.leaving.push_back(announcement(i));
}

void Database::forget(Item item) {
  const std::uint32_t i = contents_[item].participant;
  if (!contents_[item].is_announcement || !is_gone(i)) return;
  standing_[i] = Standing::unknown;
  clear(item);
}

void Database::clear(Item item, std::uint32_t j) {
  marked_[at(item, j)] = false;
  noted_[at(item, j)] = false;
  waiting_[at(item, j)] = false;
}
void Database::clear(Item item) {
  for (std::uint32_t j = 0; j < participants_; ++j) clear(item, j);
}

/// Those of somebody who is not in the database are dropped.
void Database::take_descriptors() {
  for (const Item item : std::exchange(arrived_, {})) {
    const Contents& c = contents_[item];
    if (!is_in(c.participant)) continue;
    const std::uint32_t topic = topic_of_item(c);
    Topic& t = topics_[topic];
    const bool publication = c.stream == Stream::pub;
    (publication ? t.publications : t.subscriptions).push_back(item);
    ++news_;
    for (const Item opposite : publication ? t.subscriptions : t.publications) {
      const std::uint32_t j = contents_[opposite].participant;
      if (j == c.participant) continue;
      if (is_direct(j)) mark(item, j);
      if (is_direct(c.participant)) mark(opposite, c.participant);
    }
    for (const std::uint32_t j : super_clients_) {
      if (j != c.participant) mark(item, j);
    }
    soil(topic);
  }
}

/// With `relay: once` the item joins a list for each client only once.
void Database::add(std::vector<Item>& list, Item item, std::uint32_t j) {
  if (waiting_[at(item, j)] || listed_[item]) return;
  listed_[item] = true;
  list.push_back(item);
  waiting_[at(item, j)] = profile_.relay == model::Relay::once;
}

/// The item joins a list if client j needs it. Returns whether its topic has to be looked at again,
/// because j has to acknowledge its participant first.
bool Database::check(Lists& lists, Item item, std::uint32_t j) {
  const Contents& c = contents_[item];
  const Item participant = announcement(c.participant);
  if (c.participant == j || !marked_[at(participant, j)]) return false;
  if (!noted_[at(participant, j)]) {
    add(lists.announcements, participant, j);
    return true;
  }
  if (marked_[at(item, j)] && !noted_[at(item, j)]) {
    add(c.stream == Stream::pub ? lists.publications : lists.subscriptions, item, j);
  }
  return false;
}

bool Database::check_topic(Lists& lists, const Topic& topic) {
  bool again = false;
  for (const Item w : topic.publications) {
    for (const Item r : topic.subscriptions) {
      again |= check(lists, r, contents_[w].participant);
      again |= check(lists, w, contents_[r].participant);
    }
    for (const std::uint32_t j : super_clients_) again |= check(lists, w, j);
  }
  for (const std::uint32_t j : super_clients_) {
    for (const Item r : topic.subscriptions) again |= check(lists, r, j);
  }
  return again;
}

}  // namespace stormproof::model::fastdds
