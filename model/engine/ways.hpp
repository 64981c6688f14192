// The ways in which a thing can be kept, and what a row has of it then. Flags of descriptors answer
// by words of 64, whatever they are kept as: `word(k)`, `set(d, to)`, `set_word(k, bits)`, and
// `first()`, how many of the first descriptors have it.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "fsm/stepper.hpp"
#include "model/engine/descriptor_set.hpp"
#include "model/engine/things.hpp"

namespace stormproof::model {

namespace way {
struct Cell {};      ///< a machine's state, a truth value, or a number
struct Narrow {};    ///< a number that never grows beyond 32 bits
struct Capped {};    ///< a delay that doubles, and need not any more once it is longer than any run
struct Prefix {};    ///< a flag of descriptors that holds for the first ones: how many
struct Bits {};      ///< a flag of descriptors: a bit for each
struct Planes {};    ///< machines of descriptors, as bit planes (model/engine/relation_bits.hpp)
struct InPlanes {};  ///< X, which lies with them
/// A timer that is counted, and cancelled by a new number: its events have the number as their
/// detail, from `first` on.
template <std::uint32_t first>
struct TokensFrom {};
using Tokens = TokensFrom<0>;
struct Insertions {};  ///< a timer that is cancelled by what was scheduled before
struct Nothing {};     ///< a timer that is neither counted nor cancelled
struct Elsewhere {};   ///< the host keeps it
}  // namespace way

namespace detail {

template <class T>
constexpr auto first_value() {
  if constexpr (IsMachine<T>) {
    return fsm::Stepper<typename T::Machine>::initial;
  } else if constexpr (IsFlag<T>) {
    return false;
  } else {
    return std::int64_t{};
  }
}

/// What a row has of a thing; a base of the row.
template <class T, class Way>
struct Place;
template <class T>
struct Place<T, way::Cell> {
  decltype(first_value<T>()) value = first_value<T>();
};
template <class T>
struct Place<T, way::Narrow> {
  std::uint32_t value = 0;
};
template <class T>
struct Place<T, way::Capped> {
  std::int64_t value = 0;
};

template <class T>
struct Place<T, way::Prefix> {
  std::uint32_t value = 0;

  [[nodiscard]] std::uint64_t word(std::uint32_t k) const { return bits_below(value, k); }
  void set(std::uint32_t d, bool to) { value = to ? d + 1 : d; }
  /// Words come in ascending order, and those above are read before they are written: a full word
  /// leaves them as they are.
  void set_word(std::uint32_t k, std::uint64_t bits) {
    if (~bits == 0) {
      value = std::max(value, 64 * k + 64);
    } else if (bits != 0 || value > 64 * k) {
      value = 64 * k + static_cast<std::uint32_t>(std::bit_width(bits));
    }
  }
  [[nodiscard]] std::uint32_t first() const { return value; }
  void set_first(std::uint32_t count) { value = count; }
};

template <class T>
struct Place<T, way::Bits> {
  std::vector<std::uint64_t> value;

  [[nodiscard]] std::uint64_t word(std::uint32_t k) const {
    return k < value.size() ? value[k] : 0;
  }
  void set(std::uint32_t d, bool to) {
    const std::uint64_t bit = std::uint64_t{1} << d % 64;
    set_word(d / 64, to ? word(d / 64) | bit : word(d / 64) & ~bit);
  }
  void set_word(std::uint32_t k, std::uint64_t bits) {
    if (k >= value.size()) value.resize(k + 1);
    value[k] = bits;
  }
  [[nodiscard]] std::uint32_t first() const {
    std::uint32_t count = 0;
    for (const std::uint64_t bits : value) {
      count += static_cast<std::uint32_t>(std::countr_one(bits));
      if (~bits != 0) break;
    }
    return count;
  }
  void set_first(std::uint32_t count) {
    value.clear();
    for (std::uint32_t k = 0; k < words_for(count); ++k) value.push_back(bits_below(count, k));
  }
};

template <class T, std::uint32_t first>
struct Place<T, way::TokensFrom<first>> {
  std::uint32_t token = first;
  std::uint32_t pending = 0;
};
template <class T>
struct Place<T, way::Insertions> {
  std::uint64_t before = 0;  ///< events that were scheduled before this one are cancelled
};

}  // namespace detail

}  // namespace stormproof::model
