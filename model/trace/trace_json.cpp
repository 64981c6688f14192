// Depth-limited parsing, and the walk along two values.
#include "model/trace/trace_json.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace stormproof::model::trace {

namespace {

std::string shown(const Json* value) {
  if (value == nullptr) return "absent";
  constexpr std::size_t longest = 400;
  std::string text = value->dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > longest) text = text.substr(0, longest) + " ...";
  return text;
}

const Json* member(const Json& object, const std::string& key) {
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

std::optional<Mismatch> compare(const Json* recorded, const Json* replayed,
                                const std::string& path);

std::optional<Mismatch> compare_members(const Json& recorded, const Json& replayed,
                                        const std::string& path) {
  const std::string prefix = path.empty() ? path : path + ".";
  for (const auto& [key, value] : recorded.items()) {
    if (auto found = compare(&value, member(replayed, key), prefix + key)) return found;
  }
  for (const auto& [key, value] : replayed.items()) {
    if (!recorded.contains(key)) return compare(nullptr, &value, prefix + key);
  }
  return std::nullopt;
}

std::optional<Mismatch> compare_elements(const Json& recorded, const Json& replayed,
                                         const std::string& path) {
  const std::size_t size = std::max(recorded.size(), replayed.size());
  for (std::size_t k = 0; k < size; ++k) {
    const Json* left = k < recorded.size() ? &recorded[k] : nullptr;
    const Json* right = k < replayed.size() ? &replayed[k] : nullptr;
    if (auto found = compare(left, right, path + "." + std::to_string(k))) return found;
  }
  return std::nullopt;
}

std::optional<Mismatch> compare(const Json* recorded, const Json* replayed,
                                const std::string& path) {
  if (recorded != nullptr && replayed != nullptr) {
    if (recorded->is_object() && replayed->is_object()) {
      return compare_members(*recorded, *replayed, path);
    }
    if (recorded->is_array() && replayed->is_array()) {
      return compare_elements(*recorded, *replayed, path);
    }
    if (*recorded == *replayed) return std::nullopt;
  }
  return Mismatch{path, shown(recorded), shown(replayed)};
}

}  // namespace

std::optional<Json> parse_line(std::string_view text) {
  constexpr int deepest = 32;
  bool too_deep = false;
  const auto watch = [&](int depth, Json::parse_event_t, Json&) {
    too_deep = too_deep || depth > deepest;
    return !too_deep;
  };
  Json value = Json::parse(text, watch, false);
  if (value.is_discarded() || too_deep) return std::nullopt;
  return value;
}

std::optional<Mismatch> first_difference(const Json& recorded, const Json& replayed) {
  return compare(&recorded, &replayed, "");
}

}  // namespace stormproof::model::trace
