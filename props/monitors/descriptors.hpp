// Descriptors of one stream, as a bitmap: what a packet carries or lists, and what the rules say of
// a stream. Unlike the packets' own (model/engine/descriptor_set.hpp) it can be copied, and words
// that nobody asks for are 0. A stream of 64 descriptors needs no memory but the bitmap's own.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/engine/descriptor_set.hpp"

namespace stormproof::props {

class Descriptors {
 public:
  Descriptors() = default;
  explicit Descriptors(const model::DescriptorSet& set) {
    if (set.empty()) return;
    for (std::uint32_t k = set.first_word(); k < set.end_word(); ++k) add(k, set.word(k));
  }

  void add(std::uint32_t d) { add(d / 64, std::uint64_t{1} << d % 64); }
  /// Members of word k.
  void add(std::uint32_t k, std::uint64_t members) {
    if (k == 0) {
      first_ |= members;
    } else if (members != 0) {
      if (k > others_.size()) others_.resize(k);
      others_[k - 1] |= members;
    }
  }
  /// The `count` least members, which are none from now on.
  [[nodiscard]] Descriptors take(std::size_t count) {
    Descriptors least;
    for (std::uint32_t k = 0; k <= others_.size(); ++k) {
      std::uint64_t& word = k == 0 ? first_ : others_[k - 1];
      std::uint64_t rest = word;
      for (; rest != 0 && count > 0; --count) rest &= rest - 1;
      least.add(k, word ^ rest);
      word = rest;
    }
    while (!others_.empty() && others_.back() == 0) others_.pop_back();
    return least;
  }

  [[nodiscard]] bool empty() const { return first_ == 0 && others_.empty(); }
  [[nodiscard]] std::size_t size() const {
    auto members = static_cast<std::size_t>(std::popcount(first_));
    for (const std::uint64_t word : others_)
      members += static_cast<std::size_t>(std::popcount(word));
    return members;
  }
  [[nodiscard]] bool has(std::uint32_t d) const { return (word(d / 64) >> d % 64 & 1) != 0; }
  [[nodiscard]] std::uint64_t word(std::uint32_t k) const {
    if (k == 0) return first_;
    return k <= others_.size() ? others_[k - 1] : 0;
  }
  /// The least member; only if there is one.
  [[nodiscard]] std::uint32_t least() const {
    std::uint32_t k = 0;
    while (word(k) == 0) ++k;
    return 64 * k + static_cast<std::uint32_t>(std::countr_zero(word(k)));
  }
  /// The least one that is no member.
  [[nodiscard]] std::uint32_t first_gap() const {
    std::uint32_t k = 0;
    while (word(k) == ~std::uint64_t{0}) ++k;
    return 64 * k + static_cast<std::uint32_t>(std::countr_one(word(k)));
  }
  [[nodiscard]] std::vector<std::uint32_t> list() const {
    std::vector<std::uint32_t> members;
    for (std::uint32_t k = 0; k <= others_.size(); ++k) {
      for (std::uint64_t bits = word(k); bits != 0; bits &= bits - 1) {
        members.push_back(64 * k + static_cast<std::uint32_t>(std::countr_zero(bits)));
      }
    }
    return members;
  }

  /// Whether the set has the same members.
  [[nodiscard]] bool are(const model::DescriptorSet& set) const {
    const std::uint32_t end = set.empty() ? 0 : set.end_word();
    if (end < others_.size() + 1 && !others_.empty()) return false;
    for (std::uint32_t k = 0; k < std::max(end, std::uint32_t{1}); ++k) {
      if (word(k) != set.word(k)) return false;
    }
    return true;
  }
  /// As packets have it.
  [[nodiscard]] model::DescriptorSet set() const {
    model::DescriptorSet set;
    for (std::uint32_t k = 0; k <= others_.size(); ++k) set.add(k, word(k));
    return set;
  }

  bool operator==(const Descriptors&) const = default;

 private:
  std::uint64_t first_ = 0;
  std::vector<std::uint64_t> others_;  // words 1, 2, … up to the last one with a member
};

}  // namespace stormproof::props
