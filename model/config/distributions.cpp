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
constexpr const char* key_of_cyclonedds = "cyclonedds";
constexpr const char* key_of_retired = "retired";

/// Reads one text after the other; the first mistake wins.
class DistributionReader {
 public:
  DistributionReader(const Node& map, const char* table, const std::string& name)
      : map_{map}, path_{join_path(table, name)} {
    error_ = check_keys(map, path_, {{"ships", "profile", "why"}, {}});
  }

  std::string text(std::string_view key) {
    if (error_) return {};
    const Node* node = map_.find(key);
    if (node != nullptr && node->is_scalar() && !node->text.empty()) return node->text;
    const Place& place = node == nullptr ? map_.place : node->place;
    error_ = error_at(place, fmt::format("{}.{}: {}; expected text", path_, key,
                                         node == nullptr ? "missing" : node->shown()));
    return {};
  }

  [[nodiscard]] const std::optional<InputError>& error() const { return error_; }

 private:
  const Node& map_;
  std::string path_;
  std::optional<InputError> error_;
};

/// The first of these folders that has the file.
std::optional<std::string> file_in(const std::vector<std::string>& directories) {
  for (const std::string& directory : directories) {
    const fs::path file = fs::path{directory} / file_of_distributions;
    std::error_code failed;
    if (fs::exists(file, failed)) return file.string();
  }
  return std::nullopt;
}

Result<Node> load(const std::string& file) {
  Result<Node> root = load_yaml(file);
  if (!root) return root;
  auto error =
      check_keys(*root, "", {{key_of_distributions, key_of_cyclonedds, key_of_retired}, {}});
  if (error) return *std::move(error);
  return root;
}

Result<std::vector<Distribution>> read_file(const std::string& file, const char* table) {
  const Result<Node> root = load(file);
  if (!root) return root.error();
  const Node* map = root->find(table);
  if (map == nullptr && table != key_of_distributions) return std::vector<Distribution>{};
  if (map == nullptr || !map->is_map()) {
    return error_at(map == nullptr ? root->place : map->place,
                    fmt::format("{}: {}; expected a map of distributions", table,
                                map == nullptr ? "missing" : map->shown()));
  }
  std::vector<Distribution> all;
  for (const Member& member : map->members) {
    DistributionReader reader{member.value, table, member.key};
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

Result<std::vector<Distribution>> read_distributions(const std::vector<std::string>& directories,
                                                     Rmw rmw) {
  const char* table = rmw == Rmw::cyclonedds ? key_of_cyclonedds : key_of_distributions;
  const auto file = file_in(directories);
  return file ? read_file(*file, table) : std::vector<Distribution>{};
}

Result<std::string> successor_of(const std::vector<std::string>& directories,
                                 const std::string& name) {
  const auto file = file_in(directories);
  if (!file) return std::string{};
  const Result<Node> root = load(*file);
  if (!root) return root.error();
  const Node* retired = root->find(key_of_retired);
  const Node* successor = retired == nullptr ? nullptr : retired->find(name);
  return successor == nullptr ? std::string{} : successor->text;
}

}  // namespace stormproof::model::config
