// What a Discovery Server knows of its clients and their descriptors, and whom it has to tell what:
// a client what is on the topics of which it has the other side, a super client everything, and
// descriptors of a participant only to those who have acknowledged its announcement. Another server
// is a super client that is not told what it has told. Who is gone leaves it, and who has been told
// of it is told that.
// Source: specs/guide/discovery-server.md, "The database", "Several servers", "Lives with a
// server".
#pragma once

#include <cstdint>
#include <vector>

#include "model/dds_profile.hpp"
#include "model/engine/topology.hpp"
#include "model/units.hpp"

namespace stormproof::model::fastdds {

/// What is relayed, by number.
using Item = std::uint32_t;

class Database {
 public:
  /// That of `server`, one of the topology's.
  Database(const Topology& topology, std::uint32_t server, Discovery discovery,
           const ServerProfile& profile);

  /// Items are numbered: the announcements of all participants, servers last, then the
  /// descriptors.
  [[nodiscard]] Item announcement(std::uint32_t i) const { return i; }
  [[nodiscard]] Item descriptor(std::uint32_t i, Stream s, std::uint32_t d) const {
    return first_[2 * i + index_of(s)] + d;
  }
  struct Contents {
    std::uint32_t participant = 0;
    bool is_announcement = false;
    Stream stream{};
    std::uint32_t descriptor = 0;
  };
  [[nodiscard]] const Contents& contents(Item item) const { return contents_[item]; }

  /// Whether client j has to be told the item now.
  [[nodiscard]] bool relevant(Item item, std::uint32_t j) const;
  /// Client j is told the item; returns whether that happens for the first time.
  bool tell(Item item, std::uint32_t j);
  /// What is told of i, and what i is told, is told for the first time again.
  void tell_again(std::uint32_t i);

  // What waits for the routine.
  /// i has announced itself.
  void join(std::uint32_t i) {
    is_direct_[i] = true;
    waiting_ones_.push_back({i, false});
  }
  void leave(std::uint32_t i);
  /// Another server has told of i, which it need not be told then; and of an item of i.
  void hear_of(std::uint32_t i, std::uint32_t other);
  void has(std::uint32_t other, Item item);
  /// Unless it has arrived before. Returns whether it is new.
  bool arrive(Item item);

  // The routine, step by step.
  /// Client j has acknowledged the item.
  void note(Item item, std::uint32_t j) { noted_[at(item, j)] = true; }
  bool all_noted = false;  ///< of the server's own announcement
  /// The item has left the history of its relay; a goodbye leaves the database with it.
  void forget(Item item);
  [[nodiscard]] bool is_in(std::uint32_t i) const { return standing_[i] == Standing::there; }
  [[nodiscard]] bool is_gone(std::uint32_t i) const { return standing_[i] == Standing::gone; }
  /// It is the server that hears it itself, and does not know of it from another server.
  [[nodiscard]] bool is_direct(std::uint32_t i) const { return is_direct_[i]; }
  /// What is to be sent, in order.
  struct Lists {
    std::vector<Item> leaving;   ///< descriptors of those that are gone, and withdrawn goodbyes
    std::vector<Item> goodbyes;  ///< announcements that now say that their participant is gone
    std::vector<Item> announcements;
    std::vector<Item> publications;
    std::vector<Item> subscriptions;
  };
  /// Takes in what waits, and finds out what is to be sent. The announcements are left out if
  /// nothing is new.
  [[nodiscard]] Lists update();

 private:
  struct Topic {
    std::vector<Item> publications;  // in the order of their arrival
    std::vector<Item> subscriptions;
    bool dirty = false;
  };

  [[nodiscard]] std::size_t at(Item item, std::uint32_t j) const {
    return std::size_t{item} * participants_ + j;
  }
  [[nodiscard]] std::uint32_t topic_of_item(const Contents& item) const;
  void mark(Item item, std::uint32_t j);
  void soil(std::uint32_t topic);
  void take_participants(Lists& lists);
  void take_in(Lists& lists, std::uint32_t i);
  void take_in_super_client(Lists& lists, std::uint32_t i);
  void tell_what_matches(std::uint32_t i);
  void take_leave(Lists& lists, std::uint32_t i);
  void withdraw(Lists& lists, std::uint32_t i);
  void take_descriptors();
  void clear(Item item, std::uint32_t j);
  void clear(Item item);
  void add(std::vector<Item>& list, Item item, std::uint32_t j);
  bool check(Lists& lists, Item item, std::uint32_t j);
  bool check_topic(Lists& lists, const Topic& topic);

  Discovery discovery_;
  ServerProfile profile_;
  std::uint32_t server_;
  std::uint32_t first_server_;
  std::uint32_t participants_;
  std::uint32_t shared_topics_ = 2;  // with those of user endpoints
  std::vector<Item> first_;          // by participant and stream
  std::vector<Contents> contents_;   // by item
  std::vector<Topic> topics_;
  std::vector<std::uint32_t> dirty_;  // topics, in the order in which they are looked at
  std::vector<bool> marked_;          // by item and client
  std::vector<bool> noted_;
  std::vector<bool> waiting_;
  std::vector<bool> told_;
  std::vector<bool> listed_;  // by item: in the lists of this run
  /// Of a participant: unknown, in the database, or what is left of it is a goodbye.
  enum class Standing : std::uint8_t { unknown, there, gone };
  struct Waiting {
    std::uint32_t participant = 0;
    bool leaves = false;
  };
  std::vector<Standing> standing_;  // by participant
  std::vector<bool> is_direct_;
  std::vector<Waiting> waiting_ones_;
  std::vector<Item> arrived_;
  std::vector<bool> known_;  // by item: it has arrived
  std::vector<std::uint32_t> super_clients_;
  std::uint64_t news_ = 0;
};

}  // namespace stormproof::model::fastdds
