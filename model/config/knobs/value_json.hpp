// The kinds of value of model/config/knobs/value_types.hpp as JSON: what `read` turns back into the
// value, and the JSON Schema of one value. Apart from them, because most of those who visit the
// knob tables read, and only few write.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "model/config/knobs/value_types.hpp"

namespace stormproof::model::config {

/// JSON whose keys stay in the order of the tables.
using Json = nlohmann::ordered_json;

/// `value` as its kind reads it; null if a file is to leave it out.
[[nodiscard]] Json json_of_count(const NumberType& type, std::int64_t count);
template <class Tag>
[[nodiscard]] Json json_of(const NumberType& type, const Quantity<Tag>& value) {
  return json_of_count(type, value.count());
}
template <std::integral Integer>
[[nodiscard]] Json json_of(const NumberType& type, Integer value) {
  return json_of_count(type, static_cast<std::int64_t>(value));
}
template <class Number>
[[nodiscard]] Json json_of(const UsualNumberType& type, const Number& value) {
  const Json json = json_of(static_cast<const NumberType&>(type), value);
  return json == json_of_count(type, type.usual) ? Json() : json;
}
[[nodiscard]] inline Json json_of(const SeedType&, std::uint64_t value) { return value; }
[[nodiscard]] Json json_of(const BytesOrWordType& type, Bytes value);
/// A word of a choice; `true` and `false` are YAML's own.
[[nodiscard]] inline Json json_of_word(std::string_view word) {
  if (word == "true" || word == "false") return word == "true";
  return word;
}
template <class Enum>
[[nodiscard]] Json json_of(const ChoiceType<Enum>&, const Enum& value) {
  return json_of_word(name_of(value));
}
template <class Enum>
[[nodiscard]] Json json_of(const UsualChoiceType<Enum>& type, const Enum& value) {
  return value == type.usual ? Json() : json_of_word(name_of(value));
}
[[nodiscard]] inline Json json_of(const TextType&, const std::string& value) { return value; }
[[nodiscard]] Json json_of(const TextMapType&, const std::map<std::string, std::string>& value);
[[nodiscard]] Json json_of(const RatioType&, const Ratio& value);
[[nodiscard]] Json json_of(const FractionType&, FractionParts<const std::int64_t> value);
[[nodiscard]] Json json_of(const BytesPairType&, const std::array<Bytes, 2>& value);
[[nodiscard]] Json json_of(const DurationRangeType& type, RangeParts<const Nanoseconds> value);
[[nodiscard]] inline Json json_of(const NumberSetType&, const std::vector<std::uint64_t>& value) {
  return value;
}
[[nodiscard]] inline Json json_of(const SomeNumbersType&, const std::vector<std::uint64_t>& value) {
  return value.empty() ? Json() : Json(value);
}

/// JSON Schema of one value.
[[nodiscard]] Json schema_of(const NumberType& type);
[[nodiscard]] Json schema_of(const SeedType& type);
[[nodiscard]] Json schema_of(const BytesOrWordType& type);
template <class Enum>
[[nodiscard]] Json schema_of(const ChoiceType<Enum>& type) {
  Json words = Json::array();
  for (const std::string& name : type.names()) words.push_back(json_of_word(name));
  return {{"enum", words}};
}
[[nodiscard]] Json schema_of(const TextType& type);
[[nodiscard]] Json schema_of(const TextMapType& type);
[[nodiscard]] Json schema_of(const RatioType& type);
[[nodiscard]] Json schema_of(const FractionType& type);
[[nodiscard]] Json schema_of(const BytesPairType& type);
[[nodiscard]] Json schema_of(const DurationRangeType& type);
[[nodiscard]] Json schema_of(const NumberSetType& type);

}  // namespace stormproof::model::config
