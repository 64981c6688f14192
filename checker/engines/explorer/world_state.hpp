// The state of an explored world: plain memory without padding, because states are kept by the
// hundred thousand, compared and hashed. What is where follows from the program that is explored:
// a byte for each machine, flag and count of scheduled events, a set for each flag of descriptors,
// eight bytes for each number, and all of these once for each relation, writer or reader that has
// one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "checker/engines/explorer/scope.hpp"
#include "fsm/program/program.hpp"

namespace stormproof::explorer {

/// Descriptors, one bit each.
using Members = std::uint16_t;

/// Where something is: that of relation k, or of its writer, reader or participant, whoever has it.
struct Kept {
  std::uint16_t offset = nowhere;
  std::uint16_t stride = 0;

  static constexpr std::uint16_t nowhere = UINT16_MAX;
  [[nodiscard]] bool is_kept() const { return offset != nowhere; }
  bool operator==(const Kept&) const = default;
  [[nodiscard]] std::size_t of(unsigned relation) const { return offset + relation * stride; }
};

class WorldState {
 public:
  static constexpr std::size_t capacity = 192;  ///< bytes

  /// `T`: one byte of a machine, flag or count, `Members`, or `std::int64_t`.
  template <class T>
  [[nodiscard]] T get(Kept kept, unsigned relation = 0) const {
    T value;
    std::memcpy(&value, bytes() + kept.of(relation), sizeof value);
    return value;
  }
  template <class T>
  void set(Kept kept, T value, unsigned relation = 0) {
    std::memcpy(bytes() + kept.of(relation), &value, sizeof value);
  }
  /// The bytes of something that has several.
  [[nodiscard]] std::uint8_t* at(Kept kept, unsigned relation = 0) {
    return bytes() + kept.of(relation);
  }
  [[nodiscard]] const std::uint8_t* at(Kept kept, unsigned relation = 0) const {
    return bytes() + kept.of(relation);
  }
  bool operator==(const WorldState&) const = default;

 private:
  [[nodiscard]] std::uint8_t* bytes() { return reinterpret_cast<std::uint8_t*>(words_.data()); }
  [[nodiscard]] const std::uint8_t* bytes() const {
    return reinterpret_cast<const std::uint8_t*>(words_.data());
  }

  std::array<std::uint64_t, capacity / sizeof(std::uint64_t)> words_{};
};

/// Gives everything in a state its place.
class Layout {
 public:
  using Tag = fsm::program::Tag;
  using Owner = fsm::program::Owner;

  /// `has_two_ends`: participants of both ends of the one relation have things.
  Layout(const fsm::program::Program& program, const Scope& scope, unsigned most_descriptors,
         bool has_two_ends)
      : program_{program},
        readers_{scope.readers},
        writers_{scope.writers},
        descriptors_{most_descriptors},
        has_two_ends_{has_two_ends},
        things_(program.things.size()) {
    if (readers_ > 1 && writers_ > 1) throw std::logic_error{"several readers of several writers"};
  }

  /// What is left out is false or 0, whatever it is set to.
  [[nodiscard]] Kept of(Tag thing) const { return things_[thing]; }
  /// Room for a thing of the program; a machine of descriptors is there for each of these.
  void keep(Tag thing);
  /// Room for so many bytes of each owner.
  Kept keep(std::size_t bytes, Owner owner);
  /// How much of a state is used; the rest is the same in all states.
  [[nodiscard]] std::size_t words() const { return (end_ + 7) / 8; }
  /// What has one for each relation, for each writer or for one of both, has its number there.
  [[nodiscard]] unsigned place_of(Owner owner, unsigned relation) const {
    return strides(owner) ? relation : 0;
  }

 private:
  [[nodiscard]] bool strides(Owner owner) const;
  [[nodiscard]] std::size_t size_of(const fsm::program::Thing& thing) const;

  const fsm::program::Program& program_;
  const unsigned readers_;
  const unsigned writers_;
  const unsigned descriptors_;
  const bool has_two_ends_;
  std::vector<Kept> things_;
  std::size_t end_ = 0;
};

}  // namespace stormproof::explorer
