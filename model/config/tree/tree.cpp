// Operations on trees that keep the places of their nodes: look-up, merging for `base:`, assignment
// for `--set`.
#include "model/config/tree/tree.hpp"

#include <algorithm>
#include <charconv>
#include <unordered_map>

#include <fmt/format.h>

namespace stormproof::model::config {

std::string Place::to_string() const {
  const std::string name = source ? *source : std::string{};
  return line == 0 ? name : fmt::format("{}:{}:{}", name, line, column);
}

Node Node::scalar(const Place& place, std::string text, bool quoted) {
  Node node;
  node.kind = Kind::scalar;
  node.place = place;
  node.text = std::move(text);
  node.quoted = quoted;
  return node;
}

Node Node::map(const Place& place) {
  Node node;
  node.kind = Kind::map;
  node.place = place;
  return node;
}

Node* Node::find(std::string_view key) {
  const auto member = std::ranges::find(members, key, &Member::key);
  return member == members.end() ? nullptr : &member->value;
}

const Node* Node::find(std::string_view key) const {
  const auto member = std::ranges::find(members, key, &Member::key);
  return member == members.end() ? nullptr : &member->value;
}

std::optional<Node> Node::take(std::string_view key) {
  const auto member = std::ranges::find(members, key, &Member::key);
  if (member == members.end()) return std::nullopt;
  Node value = std::move(member->value);
  members.erase(member);
  return value;
}

std::string Node::shown() const {
  switch (kind) {
    case Kind::null:
      return "nothing";
    case Kind::scalar:
      return quote(text);
    case Kind::sequence:
      return "a list";
    case Kind::map:
      return "a map";
  }
  return {};
}

std::string join_path(std::string_view path, std::string_view key) {
  return path.empty() ? std::string{key} : fmt::format("{}.{}", path, key);
}

namespace {

void collect(const Node& node, const std::string& path, Places& places) {
  for (const auto& [key, key_place, value] : node.members) {
    const std::string name = join_path(path, key);
    places.emplace(name, value.is_map() ? key_place : value.place);
    collect(value, name, places);
  }
  for (std::size_t k = 0; k < node.items.size(); ++k) {
    const std::string name = join_path(path, fmt::to_string(k));
    places.emplace(name, node.items[k].place);
    collect(node.items[k], name, places);
  }
}

}  // namespace

Places places_of(const Node& tree) {
  Places places;
  collect(tree, "", places);
  return places;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string quote(std::string_view text) {
  std::size_t length = std::min<std::size_t>(text.size(), 60);
  while (length < text.size() && length > 0 &&
         (static_cast<unsigned char>(text[length]) & 0xC0u) == 0x80u) {
    --length;  // not in the middle of a character
  }
  std::string shown = "'";
  for (const char c : text.substr(0, length)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) {
      shown += fmt::format("\\x{:02x}", byte);
    } else {
      shown += c;
    }
  }
  return shown + (text.size() > length ? "…'" : "'");
}

InputError error_at(const Place& place, std::string message) {
  return {place.to_string(), std::move(message)};
}

Node merge(Node base, Node overriding) {
  if (!base.is_map() || !overriding.is_map()) return overriding;
  std::unordered_map<std::string, std::size_t> position;
  for (std::size_t k = 0; k < base.members.size(); ++k) position.emplace(base.members[k].key, k);
  for (Member& member : overriding.members) {
    const auto known = position.find(member.key);
    if (known == position.end()) {
      base.members.push_back(std::move(member));
    } else {
      Member& old = base.members[known->second];
      old.key_place = member.key_place;
      old.value = merge(std::move(old.value), std::move(member.value));
    }
  }
  base.place = overriding.place;
  return base;
}

namespace {

/// The element of `sequence` that `number` names, or what is wrong with it.
Result<Node*, std::string> element(Node& sequence, std::string_view number) {
  std::size_t index = 0;
  const auto [end, failed] = std::from_chars(number.data(), number.data() + number.size(), index);
  if (failed != std::errc{} || end != number.data() + number.size()) {
    return fmt::format("{} is not the number of a list element", quote(number));
  }
  if (index >= sequence.items.size()) {
    return fmt::format("there is no element {}; the list has {} (numbered from 0)", index,
                       sequence.items.size());
  }
  return &sequence.items[index];
}

/// The value of `key` in `map`, which is made if need be.
Node& member_value(Node& map, std::string_view key, const Place& place) {
  if (Node* value = map.find(key)) return *value;
  map.members.push_back({std::string{key}, place, Node{}});
  map.members.back().value.place = place;
  return map.members.back().value;
}

}  // namespace

std::optional<std::string> set_path(Node& root, std::string_view path, Node value) {
  if (static_cast<std::size_t>(std::ranges::count(path, '.')) >= max_tree_depth) {
    return fmt::format("a key has at most {} parts", max_tree_depth);
  }
  Node* here = &root;
  std::string_view rest = path;
  for (bool last = false; !last;) {
    const std::size_t dot = rest.find('.');
    const std::string_view part = rest.substr(0, dot);
    last = dot == std::string_view::npos;
    if (!last) rest.remove_prefix(dot + 1);
    if (part.empty()) return fmt::format("{} has an empty part; expected key.key…", quote(path));
    if (here->kind == Node::Kind::null) here->kind = Node::Kind::map;
    if (here->is_map()) {
      here = &member_value(*here, part, value.place);
    } else if (here->is_sequence()) {
      const auto found = element(*here, part);
      if (!found) return found.error();
      here = *found;
    } else {
      return fmt::format(
          "{} has no keys below it: it is {}",
          quote(path.substr(0, static_cast<std::size_t>(part.data() - path.data()) - 1)),
          here->shown());
    }
  }
  *here = std::move(value);
  return std::nullopt;
}

}  // namespace stormproof::model::config
