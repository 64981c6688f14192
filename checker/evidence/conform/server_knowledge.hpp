// What a Discovery Server can know when: whose announcements and descriptors have arrived, what of
// it a client has to be told, and when its routine can have looked. The earliest instants: what a
// capture does not show, on the server's host, may have happened at any time before.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "checker/evidence/conform/context.hpp"
#include "checker/evidence/conform/sent_heartbeats.hpp"

namespace stormproof::conform::server {

/// Before anything, or never.
inline constexpr std::int64_t always_ns = INT64_MIN;
inline constexpr std::int64_t never_ns = INT64_MAX;

/// What a DATA of a relay is about: a participant, or an endpoint of it.
struct Item {
  std::size_t participant = 0;
  capture::EntityId endpoint = 0;  ///< 0: the participant itself

  auto operator<=>(const Item&) const = default;
};

class ServerKnowledge {
 public:
  explicit ServerKnowledge(const Context& context);

  /// Nothing: it does not say, or is about nobody that the capture knows.
  [[nodiscard]] std::optional<Item> item_of(const capture::Event& event) const;
  /// Whether the client is on the server's host.
  [[nodiscard]] bool is_hidden(std::size_t participant) const;

  /// When the server can pass the item on to the client, at the earliest: it has got it, and the
  /// client has something on the other side of its topic, or is told everything; a descriptor, only
  /// after its routine has noticed that the client has acknowledged its participant.
  [[nodiscard]] std::int64_t passes_on(const Item& item, std::size_t client) const;

 private:
  struct Endpoint {
    std::string topic{};
    bool is_publication = false;
    std::int64_t known_ns = 0;
  };
  /// When the routine can have run, and how often it can have gone on by its period.
  struct Run {
    std::int64_t from_ns = 0;
    std::int64_t to_ns = 0;
    std::uint64_t again = 0;
  };

  void learn_endpoints(std::size_t participant);
  void note_acknowledgements(const Relation& announcements);
  void note_wakes();
  [[nodiscard]] std::int64_t arrived_by(const Relation& relation, std::uint32_t descriptor) const;
  [[nodiscard]] std::uint64_t times_again(const Run& wake, const std::vector<Run>& wakes) const;
  [[nodiscard]] std::uint64_t period() const;          ///< ns, ≥ 1
  [[nodiscard]] std::uint64_t longest_period() const;  ///< with what it can be late
  [[nodiscard]] std::int64_t runs_after(std::int64_t time_ns) const;
  [[nodiscard]] std::int64_t needed(const Endpoint& one, std::size_t client) const;

  const Context& context_;
  const capture::Topology& topology_;
  std::size_t server_;
  bool is_told_everything_;  ///< super clients
  /// By participant and entity.
  std::map<Item, Endpoint> endpoints_;
  std::vector<std::int64_t> registered_;  ///< by participant
  /// By participant and client: when the client can have acknowledged it.
  std::map<std::pair<std::size_t, std::size_t>, std::int64_t> acknowledged_;
  std::vector<Run> runs_;
};

}  // namespace stormproof::conform::server
