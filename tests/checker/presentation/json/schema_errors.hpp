// Holds a JSON value against a JSON Schema, as far as generated schemas go: type, enum, properties,
// required, additionalProperties, items, prefixItems, anyOf, and $ref within the schema. What other
// files describe is taken as it is.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace stormproof::report {

class SchemaErrors {
 public:
  using Json = nlohmann::ordered_json;

  SchemaErrors(const Json& schema, const Json& value) : root_{schema} { check(schema, value, ""); }

  /// With the path of the value that each is about.
  [[nodiscard]] const std::vector<std::string>& found() const { return found_; }

 private:
  static bool has_type(const Json& value, std::string_view type) {
    if (type == "integer") return value.is_number_integer();
    if (type == "number") return value.is_number();
    return type == value.type_name();
  }

  static bool has_any_type(const Json& value, const Json& types) {
    if (types.is_string()) return has_type(value, types.get<std::string>());
    return std::any_of(types.begin(), types.end(),
                       [&](const Json& type) { return has_type(value, type.get<std::string>()); });
  }

  const Json& resolved(const std::string& reference) const {
    return root_.at(Json::json_pointer(reference.substr(1)));
  }

  void complain(const std::string& path, const std::string& what) {
    found_.push_back(path + ": " + what);
  }

  void check_members(const Json& schema, const Json& value, const std::string& path) {
    const Json none = Json::object();
    const Json& properties = schema.contains("properties") ? schema["properties"] : none;
    for (const auto& [key, member] : value.items()) {
      const std::string below = path + "." + key;
      if (properties.contains(key)) {
        check(properties[key], member, below);
      } else if (schema.contains("additionalProperties")) {
        check(schema["additionalProperties"], member, below);
      }
    }
    for (const Json& key : schema.value("required", Json::array())) {
      if (!value.contains(key.get<std::string>())) complain(path, "no " + key.dump());
    }
  }

  void check_elements(const Json& schema, const Json& value, const std::string& path) {
    const Json first = schema.value("prefixItems", Json::array());
    if (!first.empty() && value.size() != first.size()) complain(path, "another length");
    for (std::size_t k = 0; k < value.size(); ++k) {
      const std::string below = path + "[" + std::to_string(k) + "]";
      if (k < first.size()) check(first[k], value[k], below);
      if (schema.contains("items")) check(schema["items"], value[k], below);
    }
  }

  void check(const Json& schema, const Json& value, const std::string& path) {
    if (schema.is_boolean()) {
      if (!schema.get<bool>()) complain(path, "not in the schema");
      return;
    }
    if (schema.contains("$ref")) {
      const auto reference = schema["$ref"].get<std::string>();
      if (reference.starts_with('#')) check(resolved(reference), value, path);
      return;
    }
    if (schema.contains("type") && !has_any_type(value, schema["type"])) {
      complain(path, value.dump() + " is not of type " + schema["type"].dump());
      return;
    }
    if (schema.contains("enum") &&
        std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end()) {
      complain(path, value.dump() + " is none of " + schema["enum"].dump());
    }
    if (schema.contains("minimum") && value.is_number() && value < schema["minimum"]) {
      complain(path, "too small");
    }
    if (schema.contains("anyOf")) check_any(schema["anyOf"], value, path);
    if (value.is_object()) check_members(schema, value, path);
    if (value.is_array()) check_elements(schema, value, path);
  }

  /// Says what keeps the value from the form that it comes closest to.
  void check_any(const Json& forms, const Json& value, const std::string& path) {
    std::vector<std::string> before = std::exchange(found_, {});
    std::vector<std::string> least;
    for (std::size_t k = 0; k < forms.size(); ++k) {
      found_.clear();
      check(forms[k], value, path);
      if (k == 0 || found_.size() < least.size()) least = found_;
    }
    found_ = std::move(before);
    found_.insert(found_.end(), least.begin(), least.end());
  }

  const Json& root_;
  std::vector<std::string> found_;
};

}  // namespace stormproof::report
