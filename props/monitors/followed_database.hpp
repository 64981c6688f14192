// What a Discovery Server knows and has to tell whom, for the one who follows a run: as plain as
// the page states it (specs/guide/discovery-server.md, "The database"), and apart from what the
// simulator keeps. Who has to be told what is not noted but follows from what has arrived.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "model/dds_profile.hpp"
#include "model/engine/topology.hpp"
#include "model/fastdds/relayed.hpp"

namespace stormproof::props {

/// What a server relays: the announcement of a participant, or a descriptor of one of its streams.
struct RelayedItem {
  std::uint32_t participant = 0;
  std::uint32_t relay = model::fastdds::relay::announcements;
  std::uint32_t descriptor = 0;

  auto operator<=>(const RelayedItem&) const = default;
  [[nodiscard]] bool is_announcement() const {
    return relay == model::fastdds::relay::announcements;
  }
  [[nodiscard]] model::Stream stream() const {
    return relay == model::fastdds::relay::subscriptions ? model::Stream::sub : model::Stream::pub;
  }
};

class FollowedDatabase {
 public:
  FollowedDatabase(const model::Topology& topology, const model::DdsProfile& dds);

  [[nodiscard]] RelayedItem own_announcement() const { return {.participant = server_}; }
  /// Whether client j has to be told the item now.
  [[nodiscard]] bool relevant(const RelayedItem& item, std::uint32_t j) const;
  /// The descriptor of j on the other side of the topic of a descriptor, if there is one.
  [[nodiscard]] std::optional<RelayedItem> opposite(const RelayedItem& item, std::uint32_t j) const;

  // What waits for the routine.
  void join(std::uint32_t i) { joining_.push_back(i); }
  void arrive(const RelayedItem& item) { arrived_.push_back(item); }

  /// Client j has acknowledged the item.
  void note(const RelayedItem& item, std::uint32_t j) { noted_[at(item, j)] = true; }
  bool all_noted = false;  ///< of the server's own announcement

  /// What is to be sent, by relay, in order.
  using Lists = std::array<std::vector<RelayedItem>, model::fastdds::relay::count>;
  /// Takes in what waits, and finds out what is to be sent.
  [[nodiscard]] Lists update();

 private:
  /// Shared topics, then rosout, then those that only one participant has.
  using TopicKey = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;
  struct Topic {
    std::vector<RelayedItem> publications;  // in the order of their arrival
    std::vector<RelayedItem> subscriptions;
  };

  [[nodiscard]] static TopicKey topic_of(const RelayedItem& item);
  [[nodiscard]] std::size_t number(const RelayedItem& item) const {
    return first_[item.participant][item.relay] + item.descriptor;
  }
  [[nodiscard]] std::size_t at(const RelayedItem& item, std::uint32_t j) const {
    return number(item) * server_ + j;
  }
  [[nodiscard]] bool needs(const RelayedItem& item, std::uint32_t j) const;
  [[nodiscard]] bool needs_some(std::uint32_t i, std::uint32_t j) const;
  void look_at(const TopicKey& topic);
  void take_participant(std::uint32_t i, Lists& lists);
  void take_descriptor(const RelayedItem& item);
  void add(Lists& lists, const RelayedItem& item, std::uint32_t j);
  bool check(Lists& lists, const RelayedItem& item, std::uint32_t j);
  bool check_topic(Lists& lists, const Topic& topic);

  const model::Topology& topology_;
  const std::uint32_t server_;
  const bool everybody_learns_everything_;
  const bool once_;
  std::vector<std::array<std::size_t, model::fastdds::relay::count>> first_;  // by participant
  std::vector<bool> taken_;    // by item: descriptors that the routine has taken in
  std::vector<bool> noted_;    // by item and client
  std::vector<bool> waiting_;  // by item and client: it has joined a list for the client
  std::map<TopicKey, Topic> topics_;
  std::vector<TopicKey> dirty_;  // in the order in which they are looked at
  std::vector<std::uint32_t> joining_;
  std::vector<RelayedItem> arrived_;
  std::vector<std::uint32_t> super_clients_;
  std::set<RelayedItem> listed_;  // in this run
  std::uint64_t news_ = 0;
};

}  // namespace stormproof::props
