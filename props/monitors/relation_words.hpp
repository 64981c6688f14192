// A bitmap over the descriptors of every relation: what monitors remember of X, of states, of
// requests.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "model/engine/descriptor_set.hpp"
#include "model/engine/topology.hpp"

namespace stormproof::props {

class RelationWords {
 public:
  /// All bits 0.
  void reset(const model::Topology& topology) {
    first_.clear();
    std::uint32_t words = 0;
    for (std::uint32_t r = 0; r < topology.relation_count(); ++r) {
      first_.push_back(words);
      words += model::words_for(topology.descriptor_count(r));
    }
    first_.push_back(words);
    words_.assign(words, 0);
  }

  [[nodiscard]] std::uint32_t word_count(std::uint32_t relation) const {
    return first_[relation + 1] - first_[relation];
  }
  [[nodiscard]] std::uint64_t& word(std::uint32_t relation, std::uint32_t k) {
    return words_[first_[relation] + k];
  }
  [[nodiscard]] std::uint64_t word(std::uint32_t relation, std::uint32_t k) const {
    return words_[first_[relation] + k];
  }
  [[nodiscard]] bool test(std::uint32_t relation, std::uint32_t d) const {
    return (word(relation, d / 64) >> d % 64 & 1) != 0;
  }
  void add(std::uint32_t relation, const model::DescriptorSet& set) {
    if (set.empty()) return;
    for (std::uint32_t k = set.first_word(); k < set.end_word(); ++k) {
      word(relation, k) |= set.word(k);
    }
  }
  void remove(std::uint32_t relation, const model::DescriptorSet& set) {
    if (set.empty()) return;
    for (std::uint32_t k = set.first_word(); k < set.end_word(); ++k) {
      word(relation, k) &= ~set.word(k);
    }
  }
  /// The least member of `set` that is in this bitmap (`inside`) or is not; UINT32_MAX if none.
  [[nodiscard]] std::uint32_t first_of(std::uint32_t relation, const model::DescriptorSet& set,
                                       bool inside) const {
    if (set.empty()) return UINT32_MAX;
    for (std::uint32_t k = set.first_word(); k < set.end_word(); ++k) {
      const std::uint64_t hits = set.word(k) & (inside ? word(relation, k) : ~word(relation, k));
      if (hits != 0) return 64 * k + static_cast<std::uint32_t>(std::countr_zero(hits));
    }
    return UINT32_MAX;
  }

  /// Bits of word k below `limit`.
  [[nodiscard]] static std::uint64_t below(std::uint32_t limit, std::uint32_t k) {
    if (limit <= 64 * k) return 0;
    const std::uint32_t rest = limit - 64 * k;
    return rest >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << rest) - 1;
  }

 private:
  std::vector<std::uint32_t> first_;
  std::vector<std::uint64_t> words_;
};

/// A number for each descriptor of every relation.
template <class T>
class RelationValues {
 public:
  void reset(const model::Topology& topology, T value) {
    first_.clear();
    std::uint32_t next = 0;
    for (std::uint32_t r = 0; r < topology.relation_count(); ++r) {
      first_.push_back(next);
      next += topology.descriptor_count(r);
    }
    values_.assign(next, value);
  }
  [[nodiscard]] T& at(std::uint32_t relation, std::uint32_t d) {
    return values_[first_[relation] + d];
  }
  [[nodiscard]] const T& at(std::uint32_t relation, std::uint32_t d) const {
    return values_[first_[relation] + d];
  }

 private:
  std::vector<std::uint32_t> first_;
  std::vector<T> values_;
};

}  // namespace stormproof::props
