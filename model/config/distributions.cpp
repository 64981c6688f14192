// Reads distributions.yaml.
#include "model/config/distributions.hpp"

#include <optional>

#include <fmt/core.h>

#include "model/config/table_file.hpp"

namespace stormproof::model::config {
namespace {

constexpr const char* file_of_distributions = "distributions.yaml";
constexpr const char* key_of_distributions = "distributions";
constexpr const char* key_of_cyclonedds = "cyclonedds";
constexpr const char* key_of_retired = "retired";

Result<Node> load(const std::string& file) {
  return load_tables(file, {key_of_distributions, key_of_cyclonedds, key_of_retired});
}

Result<std::vector<Distribution>> read_file(const std::string& file, const char* table) {
  const Result<Node> root = load(file);
  if (!root) return root.error();
  if (root->find(table) == nullptr && table != key_of_distributions) {
    return std::vector<Distribution>{};
  }
  const auto entries = entries_of(*root, table, "distributions");
  if (!entries) return entries.error();
  std::vector<Distribution> all;
  for (const Member& member : *entries) {
    EntryReader reader{member.value, table, member.key, {"ships", "profile", "why"}};
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
  const auto file = file_in(directories, file_of_distributions);
  return file ? read_file(*file, table) : std::vector<Distribution>{};
}

Result<std::string> successor_of(const std::vector<std::string>& directories,
                                 const std::string& name) {
  const auto file = file_in(directories, file_of_distributions);
  if (!file) return std::string{};
  const Result<Node> root = load(*file);
  if (!root) return root.error();
  const Node* retired = root->find(key_of_retired);
  const Node* successor = retired == nullptr ? nullptr : retired->find(name);
  return successor == nullptr ? std::string{} : successor->text;
}

}  // namespace stormproof::model::config
