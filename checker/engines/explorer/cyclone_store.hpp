// The state of an explored world, laid out from what a composition declares: a byte for each
// machine, flag and count of scheduled events, a set for each flag of descriptors, eight bytes for
// each number, and all of these once for each reader if each has one. It is plain memory without
// padding, because states are kept by the hundred thousand, compared and hashed.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "checker/engines/explorer/world_state.hpp"
#include "fsm/composition/cyclone.hpp"
#include "fsm/composition/fastdds.hpp"
#include "fsm/composition/paper.hpp"
#include "fsm/machine_info.hpp"

namespace stormproof::explorer {

namespace comp = fsm::composition;

// What the explorer remembers besides, for the claims about repairs.
/// Listed by an ACKNACK since it was generated last.
struct Asked : comp::Flag<comp::owner::descriptor> {};
struct Generated : comp::Flag<comp::owner::descriptor> {};
/// The reader has heard that it exists; only where ACKNACKs list nothing else.
struct Announced : comp::Flag<comp::owner::descriptor> {};

/// The explored relations are opened from outside, their writer keeps the periodic policy, and they
/// have no topics. Times are marks of a frame.
using LeftOut = comp::Joined<
    fsm::TypeList<comp::AnnouncementTimer, comp::AnnouncementsSent, comp::Recognised,
                  comp::CycleStart, comp::CycleEnd, comp::BatchDue, comp::CycleBegan,
                  comp::CyclePeriod, comp::Contacted, comp::Responded, comp::AnnouncedAtStart>,
    fsm::TypeList<comp::cyclone::SpdpTimer, comp::cyclone::ReplyTimer, comp::cyclone::SpdpDue,
                  comp::cyclone::ReplyDue, comp::cyclone::RepliesSent, comp::cyclone::AckDue,
                  comp::cyclone::HeartbeatDue, comp::cyclone::LastHeartbeat,
                  comp::cyclone::AckCountsUntil, comp::cyclone::HeartbeatCountsUntil,
                  comp::cyclone::QuietUntil, comp::cyclone::HushUntil, comp::cyclone::AgainAt>,
    comp::control::Parts, comp::control::State>;

namespace detail {
template <class T, class... Ts>
constexpr bool is_among(fsm::TypeList<Ts...>) {
  return (std::is_same_v<T, Ts> || ...);
}
template <class T>
inline constexpr bool is_of_descriptors = (T::owner.indices & comp::owner::descriptor_index) != 0;
template <class T>
inline constexpr bool is_of_readers = (T::owner.indices & comp::owner::peer_index) != 0;
template <class T>
inline constexpr bool is_of_writers = (T::owner.indices & comp::owner::stream_index) != 0;
template <class T>
constexpr auto kept_as() {
  if constexpr (requires { typename T::Machine; }) {
    return fsm::StateId{};
  } else if constexpr (requires { typename T::IsNumber; }) {
    return std::int64_t{};
  } else if constexpr (requires { typename T::IsFlag; }) {
    return std::conditional_t<is_of_descriptors<T>, Members, bool>{};
  } else {
    return std::uint8_t{};  // how often a timer is scheduled
  }
}
}  // namespace detail

template <class T>
using KeptAs = decltype(detail::kept_as<T>());

/// `Things` are parts, timers, flags and numbers; a machine of descriptors is there for each of
/// `descriptors`, what belongs to a relation for each of `readers` of each of `writers`, and what
/// belongs to a writer for each of these. What is left out is false or 0, whatever it is set to.
template <class Things, unsigned descriptors, unsigned readers = 1, unsigned writers = 1>
class ComposedState {
 public:
  bool operator==(const ComposedState& other) const {
    for (std::size_t k = 0; k < words_.size(); ++k) {
      if (words_[k] != other.words_[k]) return false;
    }
    return true;
  }

  /// That of a relation, or of its writer, reader or participant, whoever has it.
  template <class T>
  [[nodiscard]] KeptAs<T> get(unsigned relation = 0) const {
    KeptAs<T> value{};
    if constexpr (size<T>() > 0) std::memcpy(&value, bytes() + offset<T>(relation), sizeof value);
    return value;
  }
  template <class T>
  void set(KeptAs<T> value, unsigned relation = 0) {
    if constexpr (size<T>() > 0) std::memcpy(bytes() + offset<T>(relation), &value, sizeof value);
  }
  /// The state of a machine, of descriptor d if each of them has one.
  template <class P>
  [[nodiscard]] fsm::StateId& state(unsigned d = 0, unsigned relation = 0) {
    return bytes()[offset<P>(relation) + d];
  }
  template <class P>
  [[nodiscard]] fsm::StateId state(unsigned d = 0, unsigned relation = 0) const {
    return bytes()[offset<P>(relation) + d];
  }
  /// The descriptors whose machines are in a state.
  template <class P>
  [[nodiscard]] Members in_state(fsm::StateId wanted, unsigned relation = 0) const {
    unsigned members = 0;
    for (unsigned d = 0; d < descriptors; ++d) {
      members |= static_cast<unsigned>(state<P>(d, relation) == wanted) << d;
    }
    return static_cast<Members>(members);
  }

 private:
  /// Bytes of one of them.
  template <class T>
  static constexpr std::size_t size() {
    if constexpr (detail::is_among<T>(LeftOut{})) return 0;
    if constexpr (requires { typename T::Machine; }) {
      return detail::is_of_descriptors<T> ? descriptors : 1;
    } else if constexpr (requires { T::counted; }) {
      return T::counted ? 1 : 0;
    } else {
      return sizeof(KeptAs<T>);
    }
  }
  /// How many of them there are, and which one is that of a relation.
  template <class T>
  static constexpr unsigned count() {
    return (detail::is_of_readers<T> ? readers : 1) * (detail::is_of_writers<T> ? writers : 1);
  }
  template <class T>
  static constexpr unsigned place(unsigned relation) {
    if constexpr (!detail::is_of_readers<T>) return relation % writers;
    if constexpr (!detail::is_of_writers<T>) return relation / writers;
    return relation;
  }
  template <class T, class... Ts>
  static constexpr std::size_t offset_in(fsm::TypeList<Ts...>) {
    std::size_t sum = 0;
    bool found = false;
    ((found = found || std::is_same_v<T, Ts>, sum += found ? 0 : size<Ts>() * count<Ts>()), ...);
    return sum;
  }
  template <class T>
  static constexpr std::size_t offset(unsigned relation) {
    constexpr std::size_t k = offset_in<T>(Things{});
    static_assert(k < offset_in<void>(Things{}), "this is not part of the state");
    return count<T>() == 1 ? k : k + place<T>(relation) * size<T>();
  }
  [[nodiscard]] unsigned char* bytes() { return reinterpret_cast<unsigned char*>(words_.data()); }
  [[nodiscard]] const unsigned char* bytes() const {
    return reinterpret_cast<const unsigned char*>(words_.data());
  }

  std::array<std::uint64_t, (offset_in<void>(Things{}) + 7) / 8> words_{};
};

}  // namespace stormproof::explorer
