// JSON and schemas of the kinds of value that do not depend on a template parameter.
#include "model/config/knobs/value_json.hpp"

#include <limits>

namespace stormproof::model::config {
namespace {

bool has_unit(const NumberType& type) {
  return type.unit() == NumberType::Unit::nanoseconds ||
         type.unit() == NumberType::Unit::bits_per_second;
}

/// A decimal number followed by one of `units`.
Json quantity_schema(const std::string& units) {
  return {{"type", "string"}, {"pattern", "^(0|[1-9][0-9]*)([.][0-9]+)?(" + units + ")$"}};
}

/// A list of two.
Json pair_schema(const NumberType& type) {
  return {{"type", "array"}, {"items", schema_of(type)}, {"minItems", 2}, {"maxItems", 2}};
}

}  // namespace

Json json_of_count(const NumberType& type, std::int64_t count) {
  return has_unit(type) ? Json(type.print(count)) : Json(count);
}

Json json_of(const BytesOrWordType& type, Bytes value) {
  return value == type.meaning ? Json(type.word) : json_of(type.number, value);
}

Json json_of(const TextMapType&, const std::map<std::string, std::string>& value) {
  return value.empty() ? Json() : Json(value);
}

Json json_of(const RatioType&, const Ratio& value) {
  return print_fraction({value.numerator, value.denominator});
}

Json json_of(const FractionType&, FractionParts<const std::int64_t> value) {
  return print_fraction({value.numerator, value.denominator});
}

Json json_of(const BytesPairType&, const std::array<Bytes, 2>& value) {
  return {value[0].count(), value[1].count()};
}

Json json_of(const DurationRangeType& type, RangeParts<const Nanoseconds> value) {
  return {json_of(type.number, value.low), json_of(type.number, value.high)};
}

Json schema_of(const NumberType& type) {
  switch (type.unit()) {
    case NumberType::Unit::nanoseconds: {
      const Json duration = quantity_schema("ns|us|ms|s");
      return type.minimum() == 0 ? Json{{"anyOf", {duration, {{"const", 0}}}}} : duration;
    }
    case NumberType::Unit::bits_per_second:
      return quantity_schema("bps|kbps|Mbps|Gbps");
    case NumberType::Unit::bytes:
    case NumberType::Unit::things:
      break;
  }
  return {{"type", "integer"}, {"minimum", type.minimum()}, {"maximum", type.maximum()}};
}

Json schema_of(const SeedType&) {
  return {
      {"type", "integer"}, {"minimum", 0}, {"maximum", std::numeric_limits<std::uint64_t>::max()}};
}

Json schema_of(const BytesOrWordType& type) {
  return {{"anyOf", {schema_of(type.number), {{"const", type.word}}}}};
}

Json schema_of(const TextType&) { return {{"type", "string"}, {"minLength", 1}}; }

Json schema_of(const TextMapType&) {
  return {{"type", "object"}, {"additionalProperties", schema_of(TextType{})}};
}

Json schema_of(const RatioType& type) {
  const Json number = {{"type", "number"}, {"exclusiveMinimum", 0}, {"maximum", type.maximum}};
  const Json text = {{"type", "string"}, {"pattern", "^([0-9]+/[0-9]+|[0-9]+([.][0-9]+)?)$"}};
  return {{"anyOf", {number, text}}};
}

Json schema_of(const FractionType& type) { return schema_of(RatioType{1, type.max_denominator}); }

Json schema_of(const BytesPairType& type) { return pair_schema(type.number); }

Json schema_of(const DurationRangeType& type) { return pair_schema(type.number); }

Json schema_of(const NumberSetType& type) {
  return {{"type", "array"}, {"items", schema_of(type.number)}};
}

}  // namespace stormproof::model::config
