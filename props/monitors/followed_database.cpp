// The routine, step by step.
#include "props/monitors/followed_database.hpp"

#include <algorithm>
#include <utility>

#include "model/fastdds/endpoints.hpp"

namespace stormproof::props {

namespace relay = model::fastdds::relay;
namespace topic = model::fastdds::topic;

namespace {
constexpr std::uint32_t rosout_publication = 1;
}  // namespace

FollowedDatabase::FollowedDatabase(const model::Topology& topology, const model::DdsProfile& dds)
    : topology_{topology},
      server_{topology.participant_count() - 1},
      everybody_learns_everything_{dds.discovery == model::Discovery::super_client},
      once_{dds.server.relay == model::Relay::once} {
  std::size_t count = 0;
  for (std::uint32_t i = 0; i <= server_; ++i) {
    auto& first = first_.emplace_back();
    first[relay::announcements] = count++;
    first[relay::publications] = count;
    count += topology.descriptor_count(i, model::Stream::pub);
    first[relay::subscriptions] = count;
    count += topology.descriptor_count(i, model::Stream::sub);
  }
  taken_.resize(count);
  noted_.resize(count * server_);
  waiting_.resize(count * server_);
}

FollowedDatabase::TopicKey FollowedDatabase::topic_of(const RelayedItem& item) {
  const std::uint32_t shared = model::fastdds::topic_of(item.stream(), item.descriptor);
  if (shared != topic::none) return {0, shared, 0, 0};
  const bool rosout = item.relay == relay::publications && item.descriptor == rosout_publication;
  if (rosout) return {1, 0, 0, 0};
  return {2, item.participant, item.relay, item.descriptor};
}

std::optional<RelayedItem> FollowedDatabase::opposite(const RelayedItem& item,
                                                      std::uint32_t j) const {
  using enum model::Stream;
  const std::uint32_t t = model::fastdds::topic_of(item.stream(), item.descriptor);
  if (t == topic::none) return {};
  const model::Stream other = item.stream() == pub ? sub : pub;
  const std::uint32_t d = model::fastdds::descriptor_on(t, other);
  if (d >= topology_.descriptor_count(j, other)) return {};
  return RelayedItem{j, other == pub ? relay::publications : relay::subscriptions, d};
}

/// Whether client j has to learn a descriptor at some time, as far as is known: it is a super
/// client, or has the other side of its topic.
bool FollowedDatabase::needs(const RelayedItem& item, std::uint32_t j) const {
  if (item.participant == j || !taken_[number(item)]) return false;
  if (std::ranges::find(super_clients_, j) != super_clients_.end()) return true;
  const auto other = opposite(item, j);
  return other && taken_[number(*other)];
}

/// Whether client j has to learn of participant i.
bool FollowedDatabase::needs_some(std::uint32_t i, std::uint32_t j) const {
  for (const std::uint32_t r : {relay::publications, relay::subscriptions}) {
    RelayedItem item{i, r, 0};
    const std::uint32_t count = topology_.descriptor_count(i, item.stream());
    for (; item.descriptor < count; ++item.descriptor) {
      if (needs(item, j)) return true;
    }
  }
  return false;
}

bool FollowedDatabase::relevant(const RelayedItem& item, std::uint32_t j) const {
  if (item == own_announcement()) return true;
  if (noted_[at(item, j)]) return false;
  if (item.is_announcement()) return needs_some(item.participant, j);
  return needs(item, j) && noted_[at({.participant = item.participant}, j)];
}

void FollowedDatabase::look_at(const TopicKey& topic) {
  if (std::ranges::find(dirty_, topic) == dirty_.end()) dirty_.push_back(topic);
}

FollowedDatabase::Lists FollowedDatabase::update() {
  Lists lists;
  listed_.clear();
  for (const std::uint32_t i : std::exchange(joining_, {})) take_participant(i, lists);
  for (const RelayedItem& item : std::exchange(arrived_, {})) take_descriptor(item);
  std::vector<TopicKey> still_dirty;
  for (const TopicKey& key : dirty_) {
    if (check_topic(lists, topics_[key])) still_dirty.push_back(key);
  }
  dirty_ = still_dirty;
  if (std::exchange(news_, 0) == 0) lists[relay::announcements].clear();
  return lists;
}

void FollowedDatabase::take_participant(std::uint32_t i, Lists& lists) {
  ++news_;
  all_noted = false;
  if (!everybody_learns_everything_) return;
  super_clients_.push_back(i);
  for (const auto& [key, topic] : topics_) look_at(key);
  if (!listed_.insert(own_announcement()).second) return;
  auto& announcements = lists[relay::announcements];
  announcements.insert(announcements.begin(), own_announcement());
}

void FollowedDatabase::take_descriptor(const RelayedItem& item) {
  ++news_;
  taken_[number(item)] = true;
  const TopicKey key = topic_of(item);
  Topic& topic = topics_[key];
  (item.relay == relay::publications ? topic.publications : topic.subscriptions).push_back(item);
  look_at(key);
}

/// With `relay: once` an item joins a list for each client only once.
void FollowedDatabase::add(Lists& lists, const RelayedItem& item, std::uint32_t j) {
  if (waiting_[at(item, j)] || !listed_.insert(item).second) return;
  lists[item.relay].push_back(item);
  waiting_[at(item, j)] = once_;
}

/// Returns whether the topic of the descriptor stays dirty: j has not acknowledged its participant.
bool FollowedDatabase::check(Lists& lists, const RelayedItem& item, std::uint32_t j) {
  const RelayedItem participant{.participant = item.participant};
  if (item.participant == j || !needs_some(item.participant, j)) return false;
  if (!noted_[at(participant, j)]) {
    add(lists, participant, j);
    return true;
  }
  if (needs(item, j) && !noted_[at(item, j)]) add(lists, item, j);
  return false;
}

bool FollowedDatabase::check_topic(Lists& lists, const Topic& topic) {
  bool again = false;
  for (const RelayedItem& w : topic.publications) {
    for (const RelayedItem& r : topic.subscriptions) {
      again |= check(lists, r, w.participant);
      again |= check(lists, w, r.participant);
    }
    for (const std::uint32_t j : super_clients_) again |= check(lists, w, j);
  }
  for (const std::uint32_t j : super_clients_) {
    for (const RelayedItem& r : topic.subscriptions) again |= check(lists, r, j);
  }
  return again;
}

}  // namespace stormproof::props
