// Strong types for the quantities and indices of the model: nanoseconds, bytes, bit rates, and the
// numbers of participants, hosts and descriptors. They exist so that a time can never be added to a
// size and a participant never be used where a host is meant. All of them are plain integers at run
// time: no floating point takes part in a trajectory.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>

namespace stormproof::model {

/// An integer amount of one dimension. `Tag` names the dimension and makes the type distinct.
template <class Tag>
class Quantity {
 public:
  constexpr Quantity() = default;
  constexpr explicit Quantity(std::int64_t count) : count_{count} {}

  [[nodiscard]] constexpr std::int64_t count() const { return count_; }

  constexpr auto operator<=>(const Quantity&) const = default;
  constexpr Quantity& operator+=(Quantity other) { return count_ += other.count_, *this; }
  constexpr Quantity& operator-=(Quantity other) { return count_ -= other.count_, *this; }
  friend constexpr Quantity operator+(Quantity a, Quantity b) {
    return Quantity{a.count_ + b.count_};
  }
  friend constexpr Quantity operator-(Quantity a, Quantity b) {
    return Quantity{a.count_ - b.count_};
  }
  friend constexpr Quantity operator*(Quantity a, std::int64_t k) { return Quantity{a.count_ * k}; }

 private:
  std::int64_t count_ = 0;
};

/// Time since the start of the run, or a duration; integer nanoseconds.
using Nanoseconds = Quantity<struct NanosecondsTag>;
/// A size on the wire or in a queue; integer bytes.
using Bytes = Quantity<struct BytesTag>;
/// A physical-layer rate; integer bits per second.
using BitsPerSecond = Quantity<struct BitsPerSecondTag>;

/// A zero-based number of one kind of thing. `Tag` names the kind.
template <class Tag>
struct Index {
  std::uint32_t value = 0;

  constexpr auto operator<=>(const Index&) const = default;
};

using ParticipantId = Index<struct ParticipantTag>;
using HostId = Index<struct HostTag>;
using DescriptorId = Index<struct DescriptorTag>;

/// The two built-in SEDP writers of a participant: publications (0) and subscriptions (1).
enum class Stream : std::uint8_t { pub = 0, sub = 1 };

inline constexpr Stream streams[] = {Stream::pub, Stream::sub};

[[nodiscard]] constexpr std::size_t index_of(Stream s) { return static_cast<std::size_t>(s); }
[[nodiscard]] constexpr const char* name_of(Stream s) { return s == Stream::pub ? "pub" : "sub"; }

}  // namespace stormproof::model
