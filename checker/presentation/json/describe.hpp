// JSON by description: a struct has one function that names its members, and its JSON follows.
//
//   template <class V>
//   void describe(V& v, const Run& run) {
//     v("t_disc_ns", run.discovery_time);         // std::optional<Nanoseconds>: null or an integer
//     v("counts", run.counts);                    // a struct with a description
//     v("verdict", run.verdict);                  // an enum with name_of
//     v.unless_empty("unmodelled", run.settings); // left out if there are none
//   }
//
// It names the same keys whatever the value: the JSON Schema follows from it, too (schema.hpp).
// The function stands in the namespace of the struct, beside it or in a <verb>_json.cpp. A key
// means the same in all verbs: specs/guide/output.md.
#pragma once

#include <cmath>
#include <concepts>
#include <memory>
#include <optional>
#include <ranges>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include <nlohmann/json.hpp>

#include "checker/presentation/json/dumped.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "model/units.hpp"

namespace stormproof::report {

template <class T>
[[nodiscard]] nlohmann::ordered_json json_of(const T& value);

/// What a description tells its members to: it collects an object.
class JsonObject {
 public:
  template <class T>
  void operator()(std::string_view key, const T& value) {
    json_[std::string{key}] = json_of(value);
  }

  /// Only if there is something: a value, or an element.
  template <class T>
  void unless_empty(std::string_view key, const T& value) {
    if (!is_empty(value)) (*this)(key, value);
  }

  /// Null instead of an empty text.
  void or_null(std::string_view key, std::string_view text) {
    json_[std::string{key}] = text.empty() ? nlohmann::ordered_json() : json_of(text);
  }

  /// What a schema beside those of the verbs describes: "../scenario.schema.json".
  void as_in(std::string_view key, std::string_view, const nlohmann::ordered_json& value) {
    json_[std::string{key}] = value;
  }

  [[nodiscard]] nlohmann::ordered_json take() && { return std::move(json_); }

 private:
  template <class T>
  static bool is_empty(const T& value) {
    if constexpr (requires { value.has_value(); }) {
      return !value.has_value();
    } else {
      return std::ranges::empty(value);
    }
  }

  nlohmann::ordered_json json_ = nlohmann::ordered_json::object();
};

/// Has a description.
template <class T>
concept Described = requires(JsonObject& object, const T& value) {
  describe(object, value);
};

namespace json_detail {

template <class T>
concept Absent = requires(const T& value) {
  static_cast<bool>(value);
  *value;
}
&&!std::is_arithmetic_v<T> && !std::is_array_v<T> && !std::convertible_to<T, std::string_view>;

template <class T>
concept Map = std::ranges::range<T> && requires {
  typename T::key_type;
  typename T::mapped_type;
};

template <class T>
concept Pair = requires(const T& value) {
  value.first;
  value.second;
};

template <class T>
inline constexpr bool is_variant = false;
template <class... T>
inline constexpr bool is_variant<std::variant<T...>> = true;

template <class T>
std::string key_text(const T& key) {
  if constexpr (std::is_enum_v<T>) {
    return std::string{name_of(key)};
  } else if constexpr (std::is_arithmetic_v<T>) {
    return std::to_string(key);
  } else {
    return std::string{std::string_view{key}};
  }
}

}  // namespace json_detail

/// The JSON of numbers (null if they are none), texts (what is no text becomes U+FFFD), enums by
/// `name_of`, nanoseconds as integers, what may be absent (null), what a variant holds, maps as
/// objects, pairs as arrays of two, other ranges as arrays, and structs by their description.
template <class T>
nlohmann::ordered_json json_of(const T& value) {
  using Json = nlohmann::ordered_json;
  if constexpr (Described<T>) {
    JsonObject object;
    describe(object, value);
    return std::move(object).take();
  } else if constexpr (std::same_as<T, Json> || std::same_as<T, std::nullptr_t>) {
    return value;
  } else if constexpr (std::same_as<T, model::Nanoseconds>) {
    return value.count();
  } else if constexpr (std::floating_point<T>) {
    return std::isfinite(value) ? Json(value) : Json();
  } else if constexpr (std::is_arithmetic_v<T>) {
    return value;
  } else if constexpr (std::is_enum_v<T>) {
    return std::string{name_of(value)};
  } else if constexpr (std::convertible_to<const T&, std::string_view>) {
    return valid_text(std::string_view{value});
  } else if constexpr (json_detail::is_variant<T>) {
    return std::visit([](const auto& one) { return json_of(one); }, value);
  } else if constexpr (json_detail::Absent<T>) {
    return value ? json_of(*value) : Json();
  } else if constexpr (json_detail::Map<T>) {
    Json json = Json::object();
    for (const auto& [key, mapped] : value) json[json_detail::key_text(key)] = json_of(mapped);
    return json;
  } else if constexpr (std::ranges::input_range<const T>) {
    Json json = Json::array();
    for (const auto& element : value) json.push_back(json_of(element));
    return json;
  } else {
    static_assert(json_detail::Pair<T>,
                  "no description: template <class V> describe(V&, const T&)");
    return Json::array({json_of(value.first), json_of(value.second)});
  }
}

}  // namespace stormproof::report
