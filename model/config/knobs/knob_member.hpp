// The member of a profile that a key names, found in the knob tables while the program is compiled:
// whoever states a rule by the key of a knob reads the member as if it had named it. A key that no
// table has does not compile.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <type_traits>
#include <utility>

#include <boost/pfr.hpp>

#include "model/config/knobs/dds_knobs.hpp"

namespace stormproof::model::config {

namespace knob_member {

/// A visitor that keeps where the member of one key is.
struct Finder {
  std::string_view key;
  const void* found = nullptr;

  constexpr void knob(std::string_view name, const auto& member, const auto&...) {
    if (name == key) found = &member;
  }
  /// A fraction has two members; neither is the knob.
  template <class Integer>
  constexpr void knob(std::string_view, const FractionParts<Integer>&, const auto&...) {}
  constexpr void section(std::string_view, const auto&...) {}
  constexpr void rule(bool, std::string_view, std::string_view) {}
};

/// The tables do not depend on the implementation, but for who has a key.
constexpr void visit_section(Finder& finder, const SpdpProfile& section) {
  visit_knobs(finder, section, ImplementationKind{});
}
constexpr void visit_section(Finder& finder, const SedpProfile& section) {
  visit_knobs(finder, section, ImplementationKind{});
}
constexpr void visit_section(Finder& finder, const ServerProfile& section) {
  visit_knobs(finder, section, ImplementationKind{});
}
constexpr void visit_section(Finder& finder, const VersionProfile& section) {
  visit_knobs(finder, section, ImplementationKind{});
}
constexpr void visit_section(Finder& finder, const AdaptiveProfile& section) {
  visit_knobs(finder, section);
}
constexpr void visit_section(Finder& finder, const Amendments& section) {
  visit_knobs(finder, section);
}

template <class Section>
inline constexpr Section sample{};
template <class Section>
inline constexpr std::size_t size = boost::pfr::tuple_size_v<Section>;

/// Which member of the section the table has under this key; their number if it has no such key.
template <class Section>
[[nodiscard]] constexpr std::size_t index_of(std::string_view key) {
  Finder finder{key};
  visit_section(finder, sample<Section>);
  std::size_t index = size<Section>;
  [&]<std::size_t... k>(std::index_sequence<k...>) {
    const auto look = [&](std::size_t number, const void* member) {
      if (member == finder.found) index = number;
    };
    (look(k, &boost::pfr::get<k>(sample<Section>)), ...);
  }
  (std::make_index_sequence<size<Section>>{});
  return index;
}

template <class Section>
[[nodiscard]] constexpr bool has_key(std::string_view key) {
  return index_of<Section>(key) < size<Section>;
}

}  // namespace knob_member

/// The member of a section of a profile that `Knob::key` names, without the `skipped` characters
/// that name the section. Flattened: it is one load of the member then.
template <class Knob, std::size_t skipped = 0, class Section>
[[nodiscard, gnu::flatten]] constexpr const auto& member_of(const Section& section) {
  constexpr std::size_t index =
      knob_member::index_of<Section>(std::string_view{Knob::key}.substr(skipped));
  static_assert(index < knob_member::size<Section>, "no knob has this key");
  return boost::pfr::get<index>(section);
}

/// The member of the profile that `Knob::key` names: "sedp.adaptive.min_period".
template <class Knob>
[[nodiscard]] constexpr const auto& knob_of(const DdsProfile& dds) {
  constexpr std::string_view key = Knob::key;
  if constexpr (key.starts_with("sedp.adaptive.")) {
    return member_of<Knob, std::string_view{"sedp.adaptive."}.size()>(dds.sedp.adaptive);
  } else if constexpr (key.starts_with("sedp.")) {
    return member_of<Knob, std::string_view{"sedp."}.size()>(dds.sedp);
  } else if constexpr (key.starts_with("spdp.")) {
    return member_of<Knob, std::string_view{"spdp."}.size()>(dds.spdp);
  } else if constexpr (key.starts_with("amendments.")) {
    // Only a profile that has them runs under rules that ask for them.
    return member_of<Knob, std::string_view{"amendments."}.size()>(*dds.amendments);
  } else if constexpr (knob_member::has_key<VersionProfile>(key)) {
    return member_of<Knob>(dds.version);
  } else {
    return member_of<Knob>(dds.server);
  }
}

/// The enumerator that a file spells so.
template <class Choice>
[[nodiscard]] constexpr Choice choice_of(std::string_view name) {
  for (std::size_t k = 0; k < enum_names<Choice>.size(); ++k) {
    if (enum_names<Choice>[k] == name) return static_cast<Choice>(k);
  }
  throw "the knob has no such value";  // no program with it compiles
}

/// Whether the choice of the profile is one of the values that the knob names.
template <class Knob>
[[nodiscard]] constexpr bool is_chosen(const DdsProfile& dds) {
  using Choice = std::remove_cvref_t<decltype(knob_of<Knob>(dds))>;
  constexpr auto chosen = [] {
    std::array<Choice, Knob::values.size()> all{};
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = choice_of<Choice>(Knob::values[k]);
    return all;
  }();
  for (const Choice one : chosen) {
    if (knob_of<Knob>(dds) == one) return true;
  }
  return false;
}

}  // namespace stormproof::model::config
