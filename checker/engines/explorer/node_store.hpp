// The states that the search has reached, each with the zone of times that it stands for. A state
// that is reached again with times that are all known already is not kept a second time; that is
// what makes the search end. Nodes that differ in their times only are a group and share the rest;
// bounds take four bytes each if all of a zone's do.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "checker/engines/explorer/arena.hpp"
#include "checker/engines/explorer/frame.hpp"

namespace stormproof::explorer {

/// How a state follows from its parent: which pending event happened, which of the packets that it
/// emitted are lost, and how comparisons of times came out that the zone had left open.
struct Label {
  std::uint8_t slot = 0;
  std::uint8_t loss_mask = 0;
  std::uint8_t choices = 0;
};

template <class State>
class NodeStore {
 public:
  static constexpr std::uint32_t none = UINT32_MAX;

  /// `words`: how much of a state is used; the rest is the same in all of them.
  explicit NodeStore(std::size_t words)
      : words_{words}, groups_by_hash_(std::size_t{1} << 10, none) {}

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(nodes_.size()); }
  [[nodiscard]] std::size_t bytes() const {
    return nodes_.size() * sizeof(Node) + groups_.size() * sizeof(Group) + keys_.bytes() +
           narrow_.bytes() + wide_.bytes();
  }
  [[nodiscard]] State state(std::uint32_t node) const {
    State state{};
    std::memcpy(static_cast<void*>(&state), group_of(node).key, words_ * sizeof(std::uint64_t));
    return state;
  }
  [[nodiscard]] std::uint32_t parent(std::uint32_t node) const { return nodes_[node].parent; }
  [[nodiscard]] Label label(std::uint32_t node) const { return nodes_[node].label; }
  [[nodiscard]] std::uint32_t depth(std::uint32_t node) const { return nodes_[node].depth; }

  /// Adds the state unless a known one covers it. Returns its number or the known one's, and
  /// whether it is new.
  std::pair<std::uint32_t, bool> add(const State& state, const Frame& frame, std::uint32_t parent,
                                     Label label) {
    Node node;
    node.group = find_group(state, frame);
    node.extent = extent_of(frame.zone());
    std::uint32_t& newest = groups_[node.group].newest;
    for (std::uint32_t k = newest; k != none; k = nodes_[k].next) {
      if (nodes_[k].extent.includes(node.extent) && covers(nodes_[k], frame.zone())) {
        return {k, false};
      }
    }
    keep(frame.zone(), node);
    node.parent = parent;
    node.next = newest;
    node.depth = parent == none ? 0 : nodes_[parent].depth + 1;
    node.label = label;
    newest = size();
    nodes_.push_back(node);
    return {size() - 1, true};
  }

  /// Fills `frame` with the pending events of the node.
  void load(std::uint32_t number, Frame& frame) const {
    const Node& node = nodes_[number];
    const Group& group = groups_[node.group];
    std::array<Slot, Frame::capacity> slots;
    std::memcpy(static_cast<void*>(slots.data()), group.key + words_, group.count * sizeof(Slot));
    if (node.narrow != nullptr) {
      frame.restore(slots.data(), group.count, node.narrow, group.losses_left);
    } else {
      frame.restore(slots.data(), group.count, node.wide, group.losses_left);
    }
  }

 private:
  /// What nodes have in common that differ in their times only.
  struct Group {
    const std::uint64_t* key = nullptr;  ///< the words of the state, then the slots
    std::uint64_t hash = 0;
    std::uint32_t newest = none;  ///< node
    std::uint8_t count = 0;
    std::uint8_t losses_left = 0;
  };
  /// Sums of bounds. A zone that covers another one has none below the other's, so most that do not
  /// are told apart without their bounds.
  struct Extent {
    std::int64_t since_now = 0;  ///< of the first row
    std::int64_t others = 0;

    [[nodiscard]] bool includes(const Extent& other) const {
      return since_now >= other.since_now && others >= other.others;
    }
  };
  struct Node {
    Extent extent{};
    const std::int32_t* narrow = nullptr;  ///< bounds, row by row; or
    const std::int64_t* wide = nullptr;    ///< these
    std::uint32_t group = 0;
    std::uint32_t parent = none;
    std::uint32_t next = none;  ///< of the group
    std::uint32_t depth = 0;
    Label label;
  };

  [[nodiscard]] const Group& group_of(std::uint32_t node) const {
    return groups_[nodes_[node].group];
  }

  static std::uint64_t mix(std::uint64_t hash, std::uint64_t word) {
    hash = (hash ^ word) * 0x9E3779B97F4A7C15U;
    return hash ^ hash >> 29;
  }
  /// State and slots as words.
  class Key {
   public:
    Key(const State& state, std::size_t words, const Frame& frame) : size_{words + frame.count()} {
      static_assert(std::has_unique_object_representations_v<State>);
      static_assert(sizeof(State) % 8 == 0 && sizeof(Slot) == 8);
      std::memcpy(words_.data(), &state, words * sizeof(std::uint64_t));
      if (frame.count() > 0) {
        std::memcpy(words_.data() + words, &frame.slot(0), frame.count() * sizeof(Slot));
      }
    }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] const std::uint64_t* data() const { return words_.data(); }
    [[nodiscard]] std::uint64_t hash(std::uint64_t start) const {
      for (std::size_t k = 0; k < size_; ++k) start = mix(start, words_[k]);
      return start;
    }
    [[nodiscard]] bool is(const std::uint64_t* other) const {
      return std::equal(data(), data() + size_, other);
    }

   private:
    std::array<std::uint64_t, sizeof(State) / 8 + Frame::capacity> words_;
    std::size_t size_;
  };
  /// The group of the state, which may be new and empty.
  std::uint32_t find_group(const State& state, const Frame& frame) {
    const Key key{state, words_, frame};
    const std::uint64_t hash = key.hash(frame.losses_left());
    const auto is = [&](const Group& group) {
      return group.hash == hash && group.count == frame.count() &&
             group.losses_left == frame.losses_left() && key.is(group.key);
    };
    std::size_t place = hash & (groups_by_hash_.size() - 1);
    for (std::uint32_t g = groups_by_hash_[place]; g != none; g = groups_by_hash_[place]) {
      if (is(groups_[g])) return g;
      place = (place + 1) & (groups_by_hash_.size() - 1);
    }
    const auto number = static_cast<std::uint32_t>(groups_.size());
    groups_by_hash_[place] = number;
    std::uint64_t* const words = keys_.allocate(key.size());
    std::copy(key.data(), key.data() + key.size(), words);
    groups_.push_back({words, hash, none, static_cast<std::uint8_t>(frame.count()),
                       static_cast<std::uint8_t>(frame.losses_left())});
    if (2 * groups_.size() > groups_by_hash_.size()) grow();
    return number;
  }
  void grow() {
    groups_by_hash_.assign(2 * groups_by_hash_.size(), none);
    for (std::uint32_t g = 0; g < groups_.size(); ++g) {
      std::size_t place = groups_[g].hash & (groups_by_hash_.size() - 1);
      while (groups_by_hash_[place] != none) place = (place + 1) & (groups_by_hash_.size() - 1);
      groups_by_hash_[place] = g;
    }
  }

  static Extent extent_of(const Zone& zone) {
    // Cut off, so that no sum overflows; cutting keeps the order.
    constexpr std::int64_t most = std::int64_t{1} << 48;
    Extent extent;
    for (unsigned i = 0; i < zone.size(); ++i) {
      std::int64_t sum = 0;
      for (unsigned j = 0; j < zone.size(); ++j) sum += std::clamp(zone.row(i)[j], -most, most);
      (i == 0 ? extent.since_now : extent.others) += sum;
    }
    return extent;
  }
  template <class Bound>
  static bool covers(const Bound* known, const Zone& zone) {
    for (unsigned i = 0; i < zone.size(); ++i, known += zone.size()) {
      const std::int64_t* const row = zone.row(i);
      bool exceeds = false;
      for (unsigned j = 0; j < zone.size(); ++j) exceeds |= row[j] > known[j];
      if (exceeds) return false;
    }
    return true;
  }
  static bool covers(const Node& node, const Zone& zone) {
    return node.narrow != nullptr ? covers(node.narrow, zone) : covers(node.wide, zone);
  }

  static bool is_narrow(const Zone& zone) {
    using Limits = std::numeric_limits<std::int32_t>;
    bool narrow = true;
    for (unsigned i = 0; i < zone.size(); ++i) {
      const std::int64_t* const row = zone.row(i);
      for (unsigned j = 0; j < zone.size(); ++j) {
        narrow &= row[j] >= Limits::min() && row[j] <= Limits::max();
      }
    }
    return narrow;
  }
  void keep(const Zone& zone, Node& node) {
    const auto copy = [&]<class Bound>(Arena<Bound>& arena) {
      Bound* const bounds = arena.allocate(std::size_t{zone.size()} * zone.size());
      for (unsigned i = 0; i < zone.size(); ++i) {
        std::transform(zone.row(i), zone.row(i) + zone.size(), bounds + i * zone.size(),
                       [](std::int64_t bound) { return static_cast<Bound>(bound); });
      }
      return bounds;
    };
    if (is_narrow(zone)) {
      node.narrow = copy(narrow_);
    } else {
      node.wide = copy(wide_);
    }
  }

  std::size_t words_;
  std::vector<Node> nodes_;
  std::vector<Group> groups_;
  std::vector<std::uint32_t> groups_by_hash_;  // open addressing
  Arena<std::uint64_t> keys_;
  Arena<std::int32_t> narrow_;
  Arena<std::int64_t> wide_;
};

}  // namespace stormproof::explorer
