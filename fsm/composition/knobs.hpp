// What a rule asks a profile for: truth values, and numbers, most of them delays in ns. A tag names
// the key of the profile that it stands for, and of a choice the values for which it is true; who
// has a profile finds the value by that name when the rule is compiled
// (model/engine/composition_knobs.hpp). Here a key is text: fsm knows no profile. Where
// participants have different profiles a tag also says whose value counts (specs/guide/profiles.md,
// "Whose value counts").
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace stormproof::fsm::composition {

/// Text as a template argument.
template <std::size_t size>
struct Text {
  std::array<char, size> characters{};

  // NOLINTNEXTLINE(google-explicit-constructor): so that a literal is an argument
  consteval Text(const char (&literal)[size]) { std::ranges::copy(literal, characters.begin()); }
  [[nodiscard]] constexpr std::string_view view() const { return {characters.data(), size - 1}; }
};

/// A truth value, or a delay in ns: of the profile, or of the deployment, or derived from several
/// knobs by whoever has them.
struct Switch {};
struct Delay {};

/// A number of the profile, of ns if it is a duration: `DelayOf<"sedp.heartbeat_period">`.
template <Text key_>
struct DelayOf : Delay {
  static constexpr std::string_view key = key_.view();
};
/// Whether a choice of the profile is one of these values: `SwitchOf<"sedp.initial_data", "push">`.
template <Text key_, Text... values_>
struct SwitchOf : Switch {
  static constexpr std::string_view key = key_.view();
  static constexpr std::array<std::string_view, sizeof...(values_)> values{values_.view()...};
};
/// Of whom a rule asks a knob that is about a pair or a relation: its source, who announces itself
/// or writes, unless the tag says that it is its destination, who recognises or reads; or both, and
/// then a switch holds if it holds for both. About a participant or a writer nobody else is asked.
struct OfDestination {};
struct OfBothEnds {};

/// One that no profile changes, in ns.
template <std::int64_t value_>
struct FixedDelay : Delay {
  static constexpr std::int64_t value = value_;
};

}  // namespace stormproof::fsm::composition
