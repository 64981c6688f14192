// Writes JSON through the knob tables, and YAML from that JSON: maps become blocks, lists and their
// elements stay in JSON's own notation, which YAML includes.
#include "model/config/knobs/effective.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "model/config/knobs/knob_writer.hpp"
#include "model/config/knobs/scenario_knobs.hpp"

namespace stormproof::model::config {
namespace {

/// Words that are no text in YAML, or in some versions of it.
constexpr std::string_view words[] = {"null", "true", "false", "yes", "no", "on"};

/// Whether `text` needs no quotes: a word, or a number with a unit. Lone digits and YAML's own
/// words need them.
bool is_plain(const std::string& text) {
  const auto is_word_character = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
           c == '.';
  };
  const char last = text.empty() ? '0' : text.back();
  const bool ends_in_letter = (last >= 'a' && last <= 'z') || (last >= 'A' && last <= 'Z');
  return ends_in_letter && std::ranges::all_of(text, is_word_character) &&
         std::ranges::find(words, text) == std::end(words);
}

/// A key of a table as it is; the free keys of a map of texts in quotes, unless they are such a
/// word.
std::string shown_key(const std::string& key) {
  const auto is_key_character = [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; };
  const bool is_plain_key = !key.empty() && std::ranges::all_of(key, is_key_character) &&
                            std::ranges::find(words, key) == std::end(words);
  return is_plain_key ? key : Json(key).dump();
}

void append_yaml(std::string& out, const Json& value, int indent) {
  for (const auto& [key, member] : value.items()) {
    out += fmt::format("{:{}}{}:", "", indent, shown_key(key));
    if (member.is_object()) {
      out += '\n';
      append_yaml(out, member, indent + 2);
    } else if (member.is_array() && !member.empty() && member.front().is_object()) {
      out += '\n';
      for (const Json& item : member)
        out += fmt::format("{:{}}- {}\n", "", indent + 2, item.dump());
    } else if (member.is_string() && is_plain(member.get<std::string>())) {
      out += fmt::format(" {}\n", member.get<std::string>());
    } else {
      out += fmt::format(" {}\n", member.dump());
    }
  }
}

}  // namespace

Json effective_json(const Scenario& scenario) { return write_knobs(scenario); }
Json effective_json(const DdsProfile& dds) { return write_knobs(dds); }
Json effective_json(const WirelessProfile& wireless) { return write_knobs(wireless); }

std::string effective_yaml(const Scenario& scenario) {
  std::string out;
  append_yaml(out, effective_json(scenario), 0);
  return out;
}

}  // namespace stormproof::model::config
