// Reads distributions.yaml, key by key, as every file in specs is read.
#include "model/config/distributions.hpp"

#include <filesystem>

#include <fmt/core.h>

#include "model/config/knobs/knob_reader.hpp"
#include "model/config/tree/yaml_text.hpp"

namespace stormproof::model::config {
namespace fs = std::filesystem;
namespace {

constexpr const char* file_of_distributions = "distributions.yaml";
constexpr const char* key_of_distributions = "distributions";

/// Reads one text after the other; the first mistake wins.
class DistributionReader {
 public:
  DistributionReader(const Node& map, const std::string& name) : map_{map}, name_{name} {
    const std::string path = join_path(key_of_distributions, name);
    error_ = check_keys(map, path, {{"ships", "profile", "why"}, {}});
  }

  std::string text(std::string_view key) {
    if (error_) return {};
    const Node* node = map_.find(key);
    if (node != nullptr && node->is_scalar() && !node->text.empty()) return node->text;
    const Place& place = node == nullptr ? map_.place : node->place;
    error_ = error_at(place, fmt::format("{}.{}.{}: {}; expected text", key_of_distributions, name_,
                                         key, node == nullptr ? "missing" : node->shown()));
    return {};
  }

  [[nodiscard]] const std::optional<InputError>& error() const { return error_; }

 private:
  const Node& map_;
  const std::string& name_;
  std::optional<InputError> error_;
};

Result<std::vector<Distribution>> read_file(const std::string& file) {
  const Result<Node> root = load_yaml(file);
  if (!root) return root.error();
  if (auto error = check_keys(*root, "", {{key_of_distributions}, {}})) return *std::move(error);
  const Node* map = root->find(key_of_distributions);
  if (map == nullptr || !map->is_map()) {
    return error_at(map == nullptr ? root->place : map->place,
                    fmt::format("{}: {}; expected a map of distributions", key_of_distributions,
                                map == nullptr ? "missing" : map->shown()));
  }
  std::vector<Distribution> all;
  for (const Member& member : map->members) {
    DistributionReader reader{member.value, member.key};
    Distribution one{member.key, reader.text("ships"), reader.text("profile"), reader.text("why"),
                     file};
    if (reader.error()) return *reader.error();
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace

bool stands_in(const Distribution& distribution) {
  const std::string version = distribution.ships.substr(distribution.ships.rfind(' ') + 1);
  return !distribution.profile.ends_with("-" + version);
}

std::string statement_of(const Distribution& distribution) {
  if (!stands_in(distribution)) {
    return fmt::format("ROS 2 {} ships {}, which {} describes", distribution.name,
                       distribution.ships, distribution.profile);
  }
  return fmt::format("ROS 2 {} ships {}; {} stands for it: {}", distribution.name,
                     distribution.ships, distribution.profile, distribution.why);
}

Result<std::vector<Distribution>> read_distributions(const std::vector<std::string>& directories) {
  for (const std::string& directory : directories) {
    const fs::path file = fs::path{directory} / file_of_distributions;
    std::error_code failed;
    if (fs::exists(file, failed)) return read_file(file.string());
  }
  return std::vector<Distribution>{};
}

}  // namespace stormproof::model::config
