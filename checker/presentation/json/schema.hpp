// JSON Schema by description: the functions that make the JSON (describe.hpp) are shown an example
// of their struct, and what they name is collected as types. So a schema says what the program
// prints, and cannot say anything else.
//
// For that, a description names the same keys for every value: `v.unless_empty` for what may be
// missing, a map for keys that depend on the value. tests/cli/schema_test.cpp holds what every verb
// prints against its schema.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <typeindex>
#include <utility>
#include <variant>

#include "checker/presentation/json/describe.hpp"
#include "checker/presentation/json/head.hpp"
#include "checker/presentation/json/schema_form.hpp"
#include "checker/presentation/json/type.hpp"

namespace stormproof::report {

namespace schema_detail {

/// "Quantiles" of stormproof::statistics::Quantiles; "OfProfileEffect" of …::OfProfile<…::Effect>.
std::string short_name(std::string_view pretty_function);

template <class T>
std::string name_of_type() {
  return short_name(__PRETTY_FUNCTION__);
}

/// Whether the enum has an enumerator of this value: a compiler writes others as a cast.
template <auto Value>
constexpr bool is_enumerator() {
  return std::string_view{__PRETTY_FUNCTION__}.find("Value = (") == std::string_view::npos;
}

inline constexpr std::size_t most_enumerators = 40;

template <class Enum, class Visit>
void each_enumerator(const Visit& visit) {
  [&]<std::size_t... k>(std::index_sequence<k...>) {
    (
        [&] {
          constexpr auto value = static_cast<Enum>(k);
          if constexpr (is_enumerator<value>()) visit(value);
        }(),
        ...);
  }
  (std::make_index_sequence<most_enumerators>{});
}

template <class T>
T& example();

/// Becomes an example of whatever an aggregate has as its member.
struct Anything {
  template <class T>
  operator T&() const {  // NOLINT(google-explicit-constructor)
    return example<std::remove_const_t<T>>();
  }
};

inline constexpr std::size_t most_members = 8;

template <class T, std::size_t... k>
concept HasMembers = requires {
  T{((void)k, Anything{})...};
};

/// The aggregate with examples of its members; as many as it has.
template <class T, std::size_t... k>
T& aggregate(std::index_sequence<k...>) {
  static_assert(sizeof...(k) > 0, "no example: T example_of(report::Type<T>)");
  if constexpr (HasMembers<T, k...>) {
    static T value{((void)k, Anything{})...};
    return value;
  } else {
    return aggregate<T>(std::make_index_sequence<sizeof...(k) - 1>{});
  }
}

/// What a description is shown: what `example_of` says, else the default, else an aggregate of
/// examples.
template <class T>
T& example() {
  if constexpr (requires { example_of(Type<T>{}); }) {
    static T value = example_of(Type<T>{});
    return value;
  } else if constexpr (std::default_initializable<T>) {
    static T value;  // static: zero, then its defaults
    return value;
  } else {
    return aggregate<T>(std::make_index_sequence<most_members>{});
  }
}

/// `schema`, or null.
nlohmann::ordered_json or_null(nlohmann::ordered_json schema);

}  // namespace schema_detail

/// The schemas of described structs, by their short name.
class SchemaDefinitions {
 public:
  template <class T>
  [[nodiscard]] nlohmann::ordered_json schema_of();

  [[nodiscard]] nlohmann::ordered_json take() && { return std::move(definitions_); }

 private:
  template <class... T>
  nlohmann::ordered_json schema_of_variant(Type<std::variant<T...>>) {
    return {{"anyOf", nlohmann::ordered_json::array({schema_of<T>()...})}};
  }

  std::map<std::type_index, std::string> names_;
  nlohmann::ordered_json definitions_ = nlohmann::ordered_json::object();
};

/// What a description tells its members to, in place of a JsonObject.
class SchemaObject {
 public:
  explicit SchemaObject(SchemaDefinitions& definitions) : definitions_{definitions} {}

  template <class T>
  void operator()(std::string_view key, const T&) {
    add(key, definitions_.schema_of<T>(), true);
  }

  template <class T>
  void unless_empty(std::string_view key, const T&) {
    if constexpr (requires(const T& value) { value.has_value(); }) {
      add(key, definitions_.schema_of<typename T::value_type>(), false);
    } else {
      add(key, definitions_.schema_of<T>(), false);
    }
  }

  void or_null(std::string_view key, std::string_view) {
    add(key, {{"type", {"string", "null"}}}, true);
  }

  void as_in(std::string_view key, std::string_view file, const nlohmann::ordered_json&) {
    add(key, {{"$ref", file}}, true);
  }

  [[nodiscard]] nlohmann::ordered_json take() &&;

 private:
  void add(std::string_view key, nlohmann::ordered_json schema, bool is_required);

  SchemaDefinitions& definitions_;
  nlohmann::ordered_json properties_ = nlohmann::ordered_json::object();
  nlohmann::ordered_json required_ = nlohmann::ordered_json::array();
};

/// What `json_of` makes of a T.
template <class T>
nlohmann::ordered_json SchemaDefinitions::schema_of() {
  using Json = nlohmann::ordered_json;
  if constexpr (Described<T>) {
    const auto [known, is_new] = names_.try_emplace(typeid(T), schema_detail::name_of_type<T>());
    std::string& name = known->second;
    if (is_new) {
      while (definitions_.contains(name)) name += "_";
      definitions_[name] = Json();
      SchemaObject object{*this};
      describe(object, schema_detail::example<T>());
      definitions_[name] = std::move(object).take();
    }
    return {{"$ref", "#/$defs/" + name}};
  } else if constexpr (std::same_as<T, Json>) {
    return true;
  } else if constexpr (std::same_as<T, std::nullptr_t>) {
    return {{"type", "null"}};
  } else if constexpr (std::same_as<T, bool>) {
    return {{"type", "boolean"}};
  } else if constexpr (std::same_as<T, model::Nanoseconds>) {
    return {{"type", "integer"}};
  } else if constexpr (std::floating_point<T>) {
    return {{"type", {"number", "null"}}};
  } else if constexpr (std::unsigned_integral<T>) {
    return {{"type", "integer"}, {"minimum", 0}};
  } else if constexpr (std::is_arithmetic_v<T>) {
    return {{"type", "integer"}};
  } else if constexpr (std::is_enum_v<T>) {
    Json names = Json::array();
    schema_detail::each_enumerator<T>([&](T value) { names.push_back(json_of(value)); });
    return {{"type", "string"}, {"enum", names}};
  } else if constexpr (std::convertible_to<const T&, std::string_view>) {
    return {{"type", "string"}};
  } else if constexpr (json_detail::is_variant<T>) {
    return schema_of_variant(Type<T>{});
  } else if constexpr (json_detail::Absent<T>) {
    return schema_detail::or_null(
        schema_of<std::remove_cvref_t<decltype(*std::declval<const T&>())>>());
  } else if constexpr (json_detail::Map<T>) {
    return {{"type", "object"}, {"additionalProperties", schema_of<typename T::mapped_type>()}};
  } else if constexpr (std::ranges::input_range<const T>) {
    return {{"type", "array"}, {"items", schema_of<std::ranges::range_value_t<const T>>()}};
  } else {
    using First = std::remove_cvref_t<decltype(std::declval<const T&>().first)>;
    using Second = std::remove_cvref_t<decltype(std::declval<const T&>().second)>;
    return {{"type", "array"},
            {"prefixItems", Json::array({schema_of<First>(), schema_of<Second>()})},
            {"minItems", 2},
            {"maxItems", 2}};
  }
}

/// A form of what `json_of` makes of a T, behind the head that every verb's JSON has.
template <class T>
[[nodiscard]] nlohmann::ordered_json schema_form(SchemaDefinitions& definitions) {
  SchemaObject object{definitions};
  describe(object, Head{});
  describe(object, schema_detail::example<T>());
  return std::move(object).take();
}

}  // namespace stormproof::report
