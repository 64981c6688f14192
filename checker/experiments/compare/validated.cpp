// Reads validated.yaml, key by key, as every file in specs is read.
#include "checker/experiments/compare/validated.hpp"

#include <charconv>
#include <filesystem>

#include <fmt/core.h>

#include "model/config/knobs/knob_reader.hpp"
#include "model/config/tree/yaml_text.hpp"

namespace stormproof::compare {

namespace config = model::config;
namespace fs = std::filesystem;
using config::Node;
using config::Result;

namespace {

constexpr const char* file_of_measurements = "observations/validated.yaml";

/// Reads one entry; the first mistake wins.
class EntryReader {
 public:
  EntryReader(const Node& map, const std::string& name) : map_{map}, name_{name} {
    error_ = config::check_keys(
        map, name, {{"what", "command", "configurations", "completion", "messages"}, {}});
  }

  std::string text(std::string_view key) {
    const Node* node = scalar(map_, std::string{key}, "text");
    return node == nullptr ? std::string{} : node->text;
  }

  double number(const Node& map, const std::string& key) {
    constexpr const char* expected = "a number of at least 0";
    const Node* node = scalar(map, key, expected);
    if (node == nullptr) return 0;
    double value = 0;
    const char* end = node->text.data() + node->text.size();
    const auto parsed = std::from_chars(node->text.data(), end, value);
    if (parsed.ec != std::errc{} || parsed.ptr != end || value < 0) fail(*node, key, expected);
    return value;
  }

  std::size_t count(const std::string& key) { return static_cast<std::size_t>(number(map_, key)); }

  Nearness nearness(const std::string& key) {
    const Node* node = error_ ? nullptr : map_.find(key);
    if (node == nullptr || !node->is_map()) {
      fail(node == nullptr ? map_ : *node, key, "a map with ratio and deviation");
      return {};
    }
    return {number(*node, "ratio"), number(*node, "deviation")};
  }

  [[nodiscard]] const std::optional<config::InputError>& error() const { return error_; }

 private:
  const Node* scalar(const Node& map, const std::string& key, const char* expected) {
    if (error_) return nullptr;
    const Node* node = map.find(key);
    if (node != nullptr && node->is_scalar() && !node->text.empty()) return node;
    fail(node == nullptr ? map : *node, key, expected);
    return nullptr;
  }

  void fail(const Node& node, const std::string& key, const char* expected) {
    if (error_) return;
    error_ = config::error_at(
        node.place, fmt::format("{}.{}: {}; expected {}", name_, key, node.shown(), expected));
  }

  const Node& map_;
  std::string name_;
  std::optional<config::InputError> error_;
};

}  // namespace

Result<Validated> read_validated(const std::vector<std::string>& directories) {
  for (const std::string& directory : directories) {
    const fs::path file = fs::path{directory} / file_of_measurements;
    std::error_code failed;
    if (!fs::exists(file, failed)) continue;
    const Result<Node> root = config::load_yaml(file.string());
    if (!root) return root.error();
    Validated all;
    for (const config::Member& member : root->members) {
      EntryReader reader{member.value, member.key};
      Measured one{reader.text("what"), reader.text("command"), reader.count("configurations"),
                   reader.nearness("completion"), reader.nearness("messages")};
      if (reader.error()) return *reader.error();
      all.emplace(member.key, std::move(one));
    }
    return all;
  }
  return Validated{};
}

}  // namespace stormproof::compare
