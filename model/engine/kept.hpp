// The part of a host (model/engine/running_world.hpp) that follows from what it keeps: states,
// flags and numbers, found in a store. Hosts inherit from hosts of other compositions, so it is a
// layer: what this one does not keep, the layers below know. A host may keep a thing in its own
// way: it declares the functions for its tag, and `using Kept::…` beside them.
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>

#include "model/engine/store.hpp"

namespace stormproof::model {

namespace detail {

/// Whether the host is told of changes of the thing.
template <class Self, class T>
constexpr bool has_hook() {
  if constexpr (std::is_same_v<T, comp::X>) {
    return requires(Self & self, const DescriptorSet& set) { self.take_descriptors(0U, set); };
  } else if constexpr (!IsFlag<T> && !IsNumber<T>) {
    return false;
  } else if constexpr (is_of_descriptors<T>) {
    return requires(Self & self) { self.changed(T{}, 0U, 0U, true); };
  } else {
    return requires(Self & self) { self.changed(T{}, 0U, first_value<T>()); };
  }
}

/// It has a function for each thing of which it hears, and for no other: a name that is misspelt
/// would never be called.
template <class Self, class Heard, class... Ts>
constexpr bool hears_what_it_says(fsm::TypeList<Ts...>) {
  return ((has_hook<Self, Ts>() == is_listed<Ts>(Heard{})) && ...);
}

}  // namespace detail

/// `Base` knows the rest. `Self` is the host itself; of what is in the list `Heard`, it is told:
///   changed(tag, n, to)         of a flag or number that changes, before it does
///   changed(tag, n, d, to)      of a flag of descriptors that is set, before it is
///   take_descriptors(r, set)    of X, instead of what `Stored` does
template <class Self, class Base, class Things, class Columns, class Heard = fsm::TypeList<>>
class Kept : public Base {
 protected:
  using Number = std::uint32_t;
  template <class T>
  static constexpr bool keeps = Store<Things, Columns>::template keeps<T>;
  template <class T>
  static constexpr bool is_heard = detail::is_listed<T>(Heard{});
  template <class T, class Way>
  static constexpr bool kept_as = [] {
    if constexpr (detail::is_listed<T>(Things{})) {
      return std::is_same_v<detail::WayOf<T, Columns>, Way>;
    } else {
      return false;
    }
  }();

 public:
  /// Those of the layers up to this one.
  using OwnThings = comp::Joined<typename Base::OwnThings, Things>;
  using OwnColumns = Columns;

  template <class... Args>
  explicit Kept(Args&&... args) : Base{std::forward<Args>(args)...}, store_{this->numbering()} {
    static_assert(Without<Heard, Things>::size == 0, "a host hears only of what its layer keeps");
    static_assert(detail::hears_what_it_says<Self, Heard>(Things{}),
                  "`changed` or `take_descriptors`, and the list of what is heard, do not agree");
  }

  /// What the owner n has of it: a value; of descriptors, how many or which.
  template <class T>
  [[nodiscard, gnu::always_inline]] auto& at(Number n) {
    if constexpr (!keeps<T>) {
      return Base::template at<T>(n);
    } else if constexpr (requires { place<T>(n).value; }) {
      return place<T>(n).value;
    } else {
      return place<T>(n);
    }
  }
  template <class T>
  [[nodiscard, gnu::always_inline]] const auto& at(Number n) const {
    return const_cast<Kept&>(*this).template at<T>(n);
  }
  template <class P>
  auto& state(P, Number n) {
    return at<P>(n);
  }

  template <class T>
  [[nodiscard]] auto value(T tag, Number n) const {
    if constexpr (!keeps<T>) {
      return Base::value(tag, n);
    } else if constexpr (IsNumber<T>) {
      return static_cast<std::int64_t>(at<T>(n));
    } else {
      return at<T>(n);
    }
  }
  template <class T, class Value>
  void assign(T tag, Number n, Value to) {
    if constexpr (!keeps<T>) {
      Base::assign(tag, n, to);
    } else {
      auto& value = at<T>(n);
      const auto next = static_cast<std::remove_reference_t<decltype(value)>>(to);
      if constexpr (is_heard<T>) {
        if (value != next) self().changed(tag, n, next);
      }
      if constexpr (kept_as<T, way::Capped>) {
        constexpr std::int64_t longest = std::int64_t{1} << 60;
        if (value >= longest) return;  // only an event that is scheduled twice gets so far
      }
      value = next;
    }
  }

  // Of descriptors.
  template <class T, class From>
  requires(keeps<T> || requires(const Base& b, T t, const From& f) { b.word(t, f, 0U); })
      [[nodiscard]] std::uint64_t word(T tag, const From& from, Number k) const {
    if constexpr (keeps<T>) {
      return place<T>(from).word(k);
    } else {
      return Base::word(tag, from, k);
    }
  }
  template <class T>
  [[nodiscard]] bool has(T tag, Number n, Number d) const {
    return (static_cast<const Self&>(*this).word(tag, n, d / 64) >> d % 64 & 1) != 0;
  }
  template <class T>
  void assign(T tag, Number n, Number d, bool to) {
    if constexpr (!keeps<T>) {
      Base::assign(tag, n, d, to);
    } else {
      if constexpr (is_heard<T>) self().changed(tag, n, d, to);
      place<T>(n).set(d, to);
    }
  }
  template <class T>
  requires(keeps<T> || requires(Base & b, T t) {
    b.assign_word(t, 0U, 0U, std::uint64_t{});
  }) void assign_word(T tag, Number n, Number k, std::uint64_t bits) {
    if constexpr (keeps<T>) {
      static_assert(!is_heard<T>, "nobody is told of whole words");
      place<T>(n).set_word(k, bits);
    } else {
      Base::assign_word(tag, n, k, bits);
    }
  }
  /// How many of the first descriptors of the owner have it, however it is kept.
  template <class T>
  [[nodiscard]] Number first(Number n) const {
    if constexpr (keeps<T>) {
      return place<T>(n).first();
    } else {
      return Base::template first<T>(n);
    }
  }
  template <class T>
  void set_first(Number n, Number count) {
    if constexpr (keeps<T>) {
      place<T>(n).set_first(count);
    } else {
      Base::template set_first<T>(n, count);
    }
  }

 protected:
  [[nodiscard]] Self& self() { return static_cast<Self&>(*this); }
  template <class T>
  [[nodiscard, gnu::always_inline]] auto& place(Number n) {
    return store_.template at<T>(Columns::row(owner_of_row<T>, n, this->numbering()));
  }
  template <class T>
  [[nodiscard, gnu::always_inline]] const auto& place(Number n) const {
    return const_cast<Kept&>(*this).template place<T>(n);
  }

 private:
  Store<Things, Columns> store_;
};

}  // namespace stormproof::model
