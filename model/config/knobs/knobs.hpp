// What a knob table is. A table is a function template `visit_knobs(visit, profile)` that names
// every key once, with the member it fills, its kind and range, and a line of documentation;
// whoever needs to know the keys visits the table: the reader, the writer of effective profiles,
// the schema, the list of knobs.
//
// A visitor has
//   knob(key, member, type, doc, presence)              one value
//   section(key, member, doc, presence, context...)     a nested table; a `std::optional` one may
//   be
//                                                       absent. The context goes to its table
//   list(key, members, size, doc, presence)             a sequence of tables
//   rule(holds, key, expected)                          a condition over several members; only the
//                                                       reader looks at it
#pragma once

#include <concepts>
#include <cstddef>
#include <string_view>
#include <type_traits>

namespace stormproof::model::config {

/// Keys that every profile may have and that are gone once it is resolved.
inline constexpr std::string_view base_key = "base";
inline constexpr std::string_view description_key =
    "description";  ///< free text; scenarios have it, too

/// `T` or `const T`: tables are visited for reading and for writing.
template <class A, class T>
concept Is = std::same_as<std::remove_const_t<A>, T>;

/// Whether a file has to have the key. An optional key that is absent leaves the member as it is,
/// and then nothing depends on it; a `defaulted` one leaves it at a default that counts.
/// `of_others` marks a key that only profiles with another implementation, or another service,
/// have: it may not be there, and the member keeps its default.
enum class Presence { required, optional, defaulted, of_others };

/// Least and greatest length of a list.
struct ListSize {
  std::size_t minimum;
  std::size_t maximum;
};

}  // namespace stormproof::model::config
