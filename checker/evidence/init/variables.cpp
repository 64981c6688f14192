// Reads variables.yaml.
#include "checker/evidence/init/variables.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/core.h>

#include "model/config/knobs/knob_reader.hpp"
#include "model/config/tree/yaml_text.hpp"

namespace stormproof::init {
namespace fs = std::filesystem;

namespace {

using model::config::error_at;
using model::config::InputError;
using model::config::Member;
using model::config::Node;
using model::config::Place;
using model::config::Result;

/// Reads one variable, key by key; the first mistake wins.
class VariableReader {
 public:
  VariableReader(const Node& map, const std::string& name)
      : map_{map}, path_{model::config::join_path("variables", name)} {
    error_ = model::config::check_keys(map, path_,
                                       {{"rmw", "read_by", "source", "refuses", "remark"}, {}});
  }

  std::string text(std::string_view key, bool is_required = true) {
    const Node* node = find(key, is_required, "text");
    if (node == nullptr) return {};
    return text_of(*node, key);
  }
  std::vector<std::string> texts(std::string_view key) {
    std::vector<std::string> all;
    const Node* node = find(key, true, "a list of distributions");
    if (node == nullptr) return all;
    if (!node->is_sequence()) complain(node->place, key, *node, "a list of distributions");
    for (const Node& item : node->items) all.push_back(text_of(item, key));
    return all;
  }
  std::vector<std::pair<std::string, std::string>> pairs(std::string_view key) {
    std::vector<std::pair<std::string, std::string>> all;
    const Node* node = find(key, false, "");
    if (node == nullptr) return all;
    if (!node->is_map()) complain(node->place, key, *node, "a map of values to reasons");
    for (const Member& member : node->members)
      all.emplace_back(member.key, text_of(member.value, key));
    return all;
  }

  [[nodiscard]] const std::optional<InputError>& error() const { return error_; }

 private:
  const Node* find(std::string_view key, bool is_required, std::string_view expected) {
    if (error_) return nullptr;
    const Node* node = map_.find(key);
    if (node == nullptr && is_required) {
      error_ =
          error_at(map_.place, fmt::format("{}.{}: missing; expected {}", path_, key, expected));
    }
    return node;
  }
  std::string text_of(const Node& node, std::string_view key) {
    if (node.is_scalar() && !node.text.empty()) return node.text;
    complain(node.place, key, node, "text");
    return {};
  }
  void complain(const Place& place, std::string_view key, const Node& node,
                std::string_view expected) {
    if (error_) return;
    error_ =
        error_at(place, fmt::format("{}.{}: {}; expected {}", path_, key, node.shown(), expected));
  }

  const Node& map_;
  std::string path_;
  std::optional<InputError> error_;
};

Result<std::vector<Variable>> read_file(const std::string& file) {
  const Result<Node> root = model::config::load_yaml(file);
  if (!root) return root.error();
  if (auto error = model::config::check_keys(*root, "", {{"variables"}, {}}))
    return *std::move(error);
  const Node* map = root->find("variables");
  if (map == nullptr || !map->is_map()) {
    return error_at(map == nullptr ? root->place : map->place,
                    fmt::format("variables: {}; expected a map of variables",
                                map == nullptr ? "missing" : map->shown()));
  }
  std::vector<Variable> all;
  for (const Member& member : map->members) {
    VariableReader reader{member.value, member.key};
    Variable one{member.key,
                 reader.text("rmw"),
                 reader.texts("read_by"),
                 reader.text("source"),
                 reader.pairs("refuses"),
                 reader.text("remark", false)};
    if (reader.error()) return *reader.error();
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace

bool Variable::is_read_by(const std::string& distribution) const {
  return std::ranges::find(read_by, distribution) != read_by.end();
}

std::string Variable::why_not(const std::string& value) const {
  for (std::size_t at = 0; at <= value.size();) {
    const std::size_t end = std::min(value.find(';', at), value.size());
    const std::string_view one =
        model::config::trimmed(std::string_view{value}.substr(at, end - at));
    for (const auto& [beginning, why] : refuses) {
      if (one.starts_with(beginning)) return why;
    }
    at = end + 1;
  }
  return {};
}

model::config::Result<std::vector<Variable>> read_variables(
    const std::vector<std::string>& directories) {
  for (const std::string& directory : directories) {
    const fs::path file = fs::path{directory} / "variables.yaml";
    std::error_code failed;
    if (fs::exists(file, failed)) return read_file(file.string());
  }
  return std::vector<Variable>{};
}

}  // namespace stormproof::init
