// Writes a struct as JSON by visiting its knob table: every key, in the order of the table, in the
// syntax of the file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/config/knobs/knobs.hpp"
#include "model/config/knobs/value_json.hpp"

namespace stormproof::model::config {

/// The JSON of one value; null for an optional that is absent.
Json write_value(const auto& type, const auto& member) {
  if constexpr (requires { member.has_value(); }) {
    return member.has_value() ? json_of(type, *member) : Json();
  } else {
    return json_of(type, member);
  }
}

class KnobWriter {
 public:
  void knob(std::string_view key, const auto& member, const auto& type, std::string_view,
            Presence presence = {}) {
    if (presence == Presence::of_others) return;
    Json value = write_value(type, member);
    if (!value.is_null()) json[std::string{key}] = std::move(value);
  }
  template <class Section>
  void section(std::string_view key, const Section& member, std::string_view,
               Presence presence = {}, const auto&... context) {
    if (presence == Presence::of_others) return;
    if constexpr (requires { member.has_value(); }) {
      if (member) section(key, *member, {}, presence, context...);
    } else {
      KnobWriter inner;
      visit_knobs(inner, member, context...);
      json[std::string{key}] = std::move(inner.json);
    }
  }
  template <class Item>
  void list(std::string_view key, const std::vector<Item>& members, ListSize, std::string_view,
            Presence presence = {}) {
    if (presence == Presence::of_others) return;
    if (presence == Presence::optional && members.empty()) return;
    Json& items = json[std::string{key}] = Json::array();
    for (const Item& member : members) {
      KnobWriter inner;
      visit_knobs(inner, member);
      items.push_back(std::move(inner.json));
    }
  }
  void rule(bool, std::string_view, std::string_view) {}

  Json json = Json::object();
};

template <class T>
Json write_knobs(const T& value) {
  KnobWriter writer;
  visit_knobs(writer, value);
  return std::move(writer.json);
}

}  // namespace stormproof::model::config
