// One row of a file of measured runs: its fields, each refused with what was expected.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "checker/evidence/coverage/observation.hpp"

namespace stormproof::prediction {

using Json = nlohmann::json;

/// Reads the fields of one row and remembers the first mistake.
class Row {
 public:
  explicit Row(const Json& json) : json_{json} {}

  [[nodiscard]] const std::string& error() const { return error_; }
  [[nodiscard]] const Json& json() const { return json_; }

  void fail(const std::string& field, const std::string& expected) {
    if (!error_.empty()) return;
    const auto found = json_.find(field);
    const std::string value = found == json_.end() ? "is missing" : "is " + found->dump();
    error_ = fmt::format("{} {}; expected {}", field, value, expected);
  }

  [[nodiscard]] bool has(const char* field) const {
    const auto found = json_.find(field);
    return found != json_.end() && !found->is_null();
  }

  [[nodiscard]] bool is_null(const char* field) const {
    const auto found = json_.find(field);
    return found != json_.end() && found->is_null();
  }

  [[nodiscard]] std::optional<double> number(const char* field, double least, double greatest,
                                             const char* expected) {
    if (!has(field)) return std::nullopt;
    const Json& value = json_[field];
    if (!value.is_number() || value.get<double>() < least || value.get<double>() > greatest) {
      fail(field, expected);
      return std::nullopt;
    }
    return value.get<double>();
  }

  [[nodiscard]] std::uint32_t count(const char* field, std::uint32_t least,
                                    std::uint32_t greatest) {
    const Json* value = has(field) ? &json_[field] : nullptr;
    if (value == nullptr || !value->is_number_integer() || value->get<double>() < least ||
        value->get<double>() > greatest) {
      fail(field, fmt::format("an integer from {} to {}", least, greatest));
      return least;
    }
    return value->get<std::uint32_t>();
  }

  [[nodiscard]] std::optional<std::string> text(const char* field) {
    if (!has(field)) return std::nullopt;
    if (json_[field].is_string()) return json_[field].get<std::string>();
    fail(field, "a string");
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Range> range(const char* field) {
    if (!has(field)) return std::nullopt;
    const Json& value = json_[field];
    const auto valid = [](const Json& end) {
      return end.is_number() && end.get<double>() >= 0 && end.get<double>() <= max_ms;
    };
    if (!value.is_array() || value.size() != 2 || !valid(value[0]) || !valid(value[1]) ||
        value[0].get<double>() > value[1].get<double>()) {
      fail(field, "[earliest, latest], two ascending times in ms from 0 to 3600000");
      return std::nullopt;
    }
    return Range{value[0].get<double>(), value[1].get<double>()};
  }

  static constexpr double max_ms = 3'600'000;
  static constexpr double max_messages = 1e12;

 private:
  const Json& json_;
  std::string error_;
};

}  // namespace stormproof::prediction
