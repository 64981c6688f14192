// The states that the search has reached, each with the zone of times that it stands for, packed
// behind each other. A state that is reached again with times that are all known already is not
// kept a second time; that is what makes the search end.
#pragma once

#include <cstdint>
#include <cstring>
#include <unordered_map>
#include <vector>

#include "checker/engines/explorer/frame.hpp"

namespace stormproof::explorer {

/// How a state follows from its parent: which pending event happened, and which of the packets that
/// it emitted are lost.
struct Label {
  std::uint8_t slot = 0;
  std::uint8_t loss_mask = 0;
};

template <class State>
class NodeStore {
 public:
  static constexpr std::uint32_t none = UINT32_MAX;

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(nodes_.size()); }
  [[nodiscard]] std::size_t bytes() const {
    return nodes_.size() * sizeof(Node) + slots_.size() * sizeof(Slot) +
           zones_.size() * sizeof(std::int64_t);
  }
  [[nodiscard]] const State& state(std::uint32_t node) const { return nodes_[node].state; }
  [[nodiscard]] std::uint32_t parent(std::uint32_t node) const { return nodes_[node].parent; }
  [[nodiscard]] Label label(std::uint32_t node) const { return nodes_[node].label; }
  [[nodiscard]] std::uint32_t depth(std::uint32_t node) const { return nodes_[node].depth; }

  /// Adds the state unless a known one covers it. Returns its number or the known one's, and
  /// whether it is new.
  std::pair<std::uint32_t, bool> add(const State& state, const Frame& frame, std::uint32_t parent,
                                     Label label) {
    const std::uint64_t hash = hash_of(state, frame);
    const auto [first, fresh] = by_hash_.try_emplace(hash, none);
    for (std::uint32_t k = first->second; k != none; k = nodes_[k].next) {
      if (same(nodes_[k], state, frame) && covers(nodes_[k], frame.zone())) return {k, false};
    }
    Node node;
    node.state = state;
    node.first_slot = slots_.size();
    node.first_bound = zones_.size();
    node.parent = parent;
    node.next = first->second;
    node.depth = parent == none ? 0 : nodes_[parent].depth + 1;
    node.label = label;
    node.count = static_cast<std::uint8_t>(frame.count());
    node.losses_left = static_cast<std::uint8_t>(frame.losses_left());
    for (unsigned k = 0; k < frame.count(); ++k) slots_.push_back(frame.slot(k));
    for (unsigned i = 0; i <= frame.count(); ++i) {
      for (unsigned j = 0; j <= frame.count(); ++j) zones_.push_back(frame.zone().bound(i, j));
    }
    first->second = size();
    nodes_.push_back(node);
    return {size() - 1, true};
  }

  /// Fills `frame` with the pending events of the node.
  void load(std::uint32_t number, Frame& frame) const {
    const Node& node = nodes_[number];
    frame.restore(slots_.data() + node.first_slot, node.count, zones_.data() + node.first_bound,
                  node.losses_left);
  }

 private:
  struct Node {
    State state;
    std::size_t first_slot = 0;
    std::size_t first_bound = 0;
    std::uint32_t parent = none;
    std::uint32_t next = none;  // with the same hash
    std::uint32_t depth = 0;
    Label label;
    std::uint8_t count = 0;
    std::uint8_t losses_left = 0;
  };

  static std::uint64_t mix(std::uint64_t hash, std::uint64_t word) {
    hash = (hash ^ word) * 0x9E3779B97F4A7C15U;
    return hash ^ hash >> 29;
  }

  static std::uint64_t hash_of(const State& state, const Frame& frame) {
    static_assert(sizeof(State) % 8 == 0 && sizeof(Slot) == 6);
    std::uint64_t hash = frame.losses_left();
    std::array<std::uint64_t, sizeof(State) / 8> words;
    std::memcpy(words.data(), &state, sizeof(State));
    for (const std::uint64_t word : words) hash = mix(hash, word);
    for (unsigned k = 0; k < frame.count(); ++k) {
      std::uint64_t word = 0;
      std::memcpy(&word, &frame.slot(k), sizeof(Slot));
      hash = mix(hash, word);
    }
    return hash;
  }

  [[nodiscard]] bool same(const Node& node, const State& state, const Frame& frame) const {
    if (node.count != frame.count() || node.losses_left != frame.losses_left()) return false;
    if (!(node.state == state)) return false;
    for (unsigned k = 0; k < node.count; ++k) {
      if (!(slots_[node.first_slot + k] == frame.slot(k))) return false;
    }
    return true;
  }

  [[nodiscard]] bool covers(const Node& node, const Zone& zone) const {
    const std::int64_t* bound = &zones_[node.first_bound];
    for (unsigned i = 0; i <= node.count; ++i) {
      for (unsigned j = 0; j <= node.count; ++j) {
        if (zone.bound(i, j) > *bound++) return false;
      }
    }
    return true;
  }

  std::vector<Node> nodes_;
  std::vector<Slot> slots_;
  std::vector<std::int64_t> zones_;
  std::unordered_map<std::uint64_t, std::uint32_t> by_hash_;
};

}  // namespace stormproof::explorer
