// Reads tables: the folder, the map, and the keys of an entry.
#include "model/config/table_file.hpp"

#include <filesystem>

#include <fmt/core.h>

#include "model/config/knobs/knob_reader.hpp"
#include "model/config/tree/yaml_text.hpp"

namespace stormproof::model::config {

std::optional<std::string> file_in(const std::vector<std::string>& directories,
                                   const std::string& name) {
  for (const std::string& directory : directories) {
    const std::filesystem::path file = std::filesystem::path{directory} / name;
    std::error_code failed;
    if (std::filesystem::exists(file, failed)) return file.string();
  }
  return std::nullopt;
}

Result<Node> load_tables(const std::string& file, const std::vector<std::string>& tables) {
  Result<Node> root = load_yaml(file);
  if (!root) return root;
  if (auto error = check_keys(*root, "", {tables, {}})) return *std::move(error);
  return root;
}

Result<std::vector<Member>> entries_of(const Node& root, std::string_view table,
                                       std::string_view what) {
  const Node* map = root.find(table);
  if (map != nullptr && map->is_map()) return map->members;
  return error_at(map == nullptr ? root.place : map->place,
                  fmt::format("{}: {}; expected a map of {}", table,
                              map == nullptr ? "missing" : map->shown(), what));
}

EntryReader::EntryReader(const Node& map, std::string_view table, const std::string& name,
                         const std::vector<std::string>& keys)
    : map_{map}, path_{join_path(table, name)}, error_{check_keys(map, path_, {keys, {}})} {}

std::string EntryReader::text(std::string_view key) {
  const Node* node = required(key, "text");
  return node == nullptr ? std::string{} : text_of(*node, key);
}

std::string EntryReader::optional_text(std::string_view key) {
  const Node* node = error_ ? nullptr : map_.find(key);
  return node == nullptr ? std::string{} : text_of(*node, key);
}

std::vector<std::string> EntryReader::texts(std::string_view key, std::string_view what) {
  std::vector<std::string> all;
  const std::string expected = fmt::format("a list of {}", what);
  const Node* node = required(key, expected);
  if (node == nullptr) return all;
  if (!node->is_sequence()) complain(*node, key, expected);
  for (const Node& item : node->items) all.push_back(text_of(item, key));
  return all;
}

std::vector<std::pair<std::string, std::string>> EntryReader::pairs(std::string_view key,
                                                                    std::string_view what) {
  std::vector<std::pair<std::string, std::string>> all;
  const Node* node = error_ ? nullptr : map_.find(key);
  if (node == nullptr) return all;
  if (!node->is_map()) complain(*node, key, fmt::format("a map of {}", what));
  for (const Member& member : node->members) {
    all.emplace_back(member.key, text_of(member.value, key));
  }
  return all;
}

const Node* EntryReader::required(std::string_view key, std::string_view expected) {
  if (error_) return nullptr;
  const Node* node = map_.find(key);
  if (node == nullptr) {
    error_ = error_at(map_.place, fmt::format("{}.{}: missing; expected {}", path_, key, expected));
  }
  return node;
}

std::string EntryReader::text_of(const Node& node, std::string_view key) {
  if (node.is_scalar() && !node.text.empty()) return node.text;
  complain(node, key, "text");
  return {};
}

void EntryReader::complain(const Node& node, std::string_view key, std::string_view expected) {
  if (error_) return;
  error_ = error_at(node.place,
                    fmt::format("{}.{}: {}; expected {}", path_, key, node.shown(), expected));
}

}  // namespace stormproof::model::config
