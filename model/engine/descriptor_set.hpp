// A set of descriptors of one stream, as a packet carries it: the descriptors of a DATA packet, or
// the bitmap of an ACKNACK. It keeps only the 64-bit words between its first and its last member,
// and a single word without any allocation, because millions of packets may wait in the backlogs of
// a storm.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

namespace stormproof::model {

/// Words of a bitmap over the descriptors 0, 1, …; descriptor d is bit d mod 64 of word d / 64.
using Words = std::span<const std::uint64_t>;

[[nodiscard]] constexpr std::uint32_t words_for(std::uint32_t descriptors) {
  return (descriptors + 63) / 64;
}

/// Bits of word k that belong to descriptors below `limit`.
[[nodiscard]] constexpr std::uint64_t bits_below(std::uint32_t limit, std::uint32_t k) {
  if (limit <= 64 * k) return 0;
  const std::uint32_t rest = limit - 64 * k;
  return rest >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << rest) - 1;
}

class DescriptorSet {
 public:
  DescriptorSet() = default;

  explicit DescriptorSet(Words words) {
    std::size_t begin = 0;
    std::size_t end = words.size();
    while (begin < end && words[begin] == 0) ++begin;
    while (begin < end && words[end - 1] == 0) --end;
    first_ = static_cast<std::uint32_t>(begin);
    count_ = static_cast<std::uint32_t>(end - begin);
    if (count_ == 1) single_ = words[begin];
    if (count_ > 1) {
      many_ = std::make_unique<std::uint64_t[]>(count_);
      std::ranges::copy(words.subspan(begin, count_), many_.get());
    }
  }

  /// Adds members of word k, which is the last one that has members, or a later one.
  void add(std::uint32_t k, std::uint64_t members) {
    if (members == 0) return;
    if (count_ == 0) first_ = k;
    if (k >= first_ + count_) grow(k + 1 - first_);
    (count_ == 1 ? single_ : many_[k - first_]) |= members;
  }

  [[nodiscard]] bool empty() const { return count_ == 0; }

  /// Word k of the bitmap; 0 outside the words that are kept.
  [[nodiscard]] std::uint64_t word(std::uint32_t k) const {
    if (k < first_ || k - first_ >= count_) return 0;
    return count_ == 1 ? single_ : many_[k - first_];
  }

  /// Number of the first word that has a member; only for a set that is not empty.
  [[nodiscard]] std::uint32_t first_word() const { return first_; }
  /// One past the number of the last word that has a member; only for a set that is not empty.
  [[nodiscard]] std::uint32_t end_word() const { return first_ + count_; }

  /// The least member, or UINT32_MAX for the empty set.
  [[nodiscard]] std::uint32_t lowest() const {
    if (empty()) return UINT32_MAX;
    return first_ * 64 + static_cast<std::uint32_t>(std::countr_zero(word(first_)));
  }

  /// The greatest member; only for a set that is not empty.
  [[nodiscard]] std::uint32_t highest() const {
    const std::uint32_t k = first_ + count_ - 1;
    return k * 64 + 63 - static_cast<std::uint32_t>(std::countl_zero(word(k)));
  }

  /// Number of members.
  [[nodiscard]] std::uint32_t count() const {
    std::uint32_t members = 0;
    for (std::uint32_t k = first_; k < first_ + count_; ++k) {
      members += static_cast<std::uint32_t>(std::popcount(word(k)));
    }
    return members;
  }

  /// Calls `visit(d)` for each member in ascending order.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (std::uint32_t k = first_; k < first_ + count_; ++k) {
      for (std::uint64_t bits = word(k); bits != 0; bits &= bits - 1) {
        visit(k * 64 + static_cast<std::uint32_t>(std::countr_zero(bits)));
      }
    }
  }

 private:
  void grow(std::uint32_t count) {
    if (count > 1) {
      auto words = std::make_unique<std::uint64_t[]>(count);
      for (std::uint32_t k = 0; k < count_; ++k) words[k] = word(first_ + k);
      many_ = std::move(words);
    }
    count_ = count;
  }

  std::uint32_t first_ = 0;
  std::uint32_t count_ = 0;
  std::uint64_t single_ = 0;
  std::unique_ptr<std::uint64_t[]> many_;
};

}  // namespace stormproof::model
