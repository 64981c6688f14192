// Reads the keys of a grid file: description, base, scenarios, grid, samples, seed.
#include <filesystem>

#include <fmt/format.h>

#include "checker/experiments/grids/grid.hpp"
#include "model/config/knobs/knob_reader.hpp"
#include "model/config/spec_path.hpp"
#include "model/config/tree/yaml_text.hpp"

namespace stormproof::grids {

namespace fs = std::filesystem;
namespace config = model::config;
using config::error_at;
using config::InputError;
using config::Node;
using config::Result;
using config::SpecPath;

namespace {

using Failure = std::optional<InputError>;

class GridReader {
 public:
  GridReader(const Node& root, std::string source, const SpecPath& specs)
      : root_{root}, specs_{specs} {
    grid_.source = std::move(source);
    grid_.place = root.place;
  }

  Result<Grid> read() {
    Failure failure = check_shape();
    if (!failure) failure = read_base();
    if (!failure) failure = read_variants();
    if (!failure) failure = read_axes();
    if (!failure) failure = read_samples();
    if (!failure) failure = check_size();
    if (failure) return *std::move(failure);
    return std::move(grid_);
  }

 private:
  Failure check_shape() const {
    const config::KnownKeys keys{{"description", "base", "scenarios", "grid", "samples", "seed"},
                                 {}};
    if (Failure failure = config::check_keys(root_, "", keys)) return failure;
    const Node* description = root_.find(config::description_key);
    if (description == nullptr || description->is_scalar()) return std::nullopt;
    return error_at(description->place,
                    fmt::format("description: {}; expected text", description->shown()));
  }

  /// The scenario that `reference` means: a name, a file beside the grid, or a map.
  Result<Node> scenario_tree(const Node& reference, const std::string& key) const {
    if (reference.is_map()) return reference;
    if (!reference.is_scalar()) {
      return error_at(reference.place, fmt::format("{}: {}; expected the name or file of a scenario"
                                                   " or a map",
                                                   key, reference.shown()));
    }
    const std::string folder = fs::path{grid_.source}.parent_path().string();
    const auto file = specs_.find(config::SpecKind::scenarios, reference.text, folder,
                                  reference.place.to_string());
    if (!file) return file.error();
    Result<Node> tree = config::load_yaml(*file);
    if (tree && !tree->is_map()) {
      return error_at(tree->place, fmt::format("{} as a scenario; expected a map", tree->shown()));
    }
    return tree;
  }

  Failure read_base() {
    const Node* base = root_.find("base");
    if (base == nullptr) return std::nullopt;
    Result<Node> tree = scenario_tree(*base, "base");
    if (!tree) return tree.error();
    base_ = *std::move(tree);
    return std::nullopt;
  }

  /// A name, a file, or a map of overrides of the base; its own `base`, if any, counts instead.
  Result<Variant> read_variant(const Node& item, const std::string& key) const {
    Variant variant;
    const Node* own_base = item.is_map() ? item.find("base") : &item;
    if (own_base == nullptr && !base_) {
      return error_at(item.place, fmt::format("{}: a map without base, in a file without base; "
                                              "expected one of them",
                                              key));
    }
    if (own_base == nullptr) {
      variant.root = *base_;
    } else {
      Result<Node> tree = scenario_tree(*own_base, key);
      if (!tree) return tree.error();
      variant.root = *std::move(tree);
      variant.name = flow_text(*own_base);
    }
    for (const config::Member& member : item.members) {
      if (member.key == "base") continue;
      variant.overrides.push_back({member.key, member.value});
      variant.name += fmt::format("{}{}={}", variant.name.empty() ? "" : " ", member.key,
                                  flow_text(member.value));
    }
    return variant;
  }

  Failure read_variants() {
    const Node* list = root_.find("scenarios");
    if (list == nullptr && !base_) {
      return error_at(root_.place,
                      "neither base nor scenarios; expected base, the scenario that is varied, or "
                      "scenarios, a list of them");
    }
    if (list == nullptr) {
      grid_.variants.push_back({"", *base_, {}});
      return std::nullopt;
    }
    if (!list->is_sequence() || list->items.empty()) {
      return error_at(list->place,
                      fmt::format("scenarios: {}; expected a list of names, files, or maps of "
                                  "overrides {{key: value}}",
                                  list->is_sequence() ? "an empty list" : list->shown()));
    }
    grid_.has_variants = true;
    for (std::size_t k = 0; k < list->items.size(); ++k) {
      Result<Variant> variant = read_variant(list->items[k], fmt::format("scenarios.{}", k));
      if (!variant) return variant.error();
      grid_.variants.push_back(*std::move(variant));
    }
    return std::nullopt;
  }

  Failure read_axes() {
    const Node* map = root_.find("grid");
    if (map == nullptr) return std::nullopt;
    if (!map->is_map() || map->members.empty()) {
      return error_at(map->place,
                      fmt::format("grid: {}; expected a map of keys to lists of values, such as "
                                  "deployment.participants_per_host: [1, 2]",
                                  map->is_map() ? "an empty map" : map->shown()));
    }
    for (const config::Member& member : map->members) {
      auto values = read_values(member.value, member.key);
      if (!values) return values.error();
      grid_.axes.push_back({member.key, *std::move(values)});
    }
    return std::nullopt;
  }

  Failure read_samples() {
    const Node* samples = root_.find("samples");
    const Node* seed = root_.find("seed");
    if (seed != nullptr && samples == nullptr) {
      return error_at(seed->place,
                      "seed: there are no samples; expected samples beside it, or "
                      "deployment.schedule.seed in the grid");
    }
    if (samples == nullptr) return std::nullopt;
    const auto count = number(*samples);
    if (!count || *count < 1 || *count > static_cast<std::int64_t>(max_jobs)) {
      return error_at(samples->place, fmt::format("samples: {}; expected a number from 1 to {}",
                                                  samples->shown(), max_jobs));
    }
    grid_.samples = static_cast<std::size_t>(*count);
    if (seed == nullptr) return std::nullopt;
    const auto first = number(*seed);
    if (!first) {
      return error_at(seed->place,
                      fmt::format("seed: {}; expected a number from 0", seed->shown()));
    }
    grid_.first_seed = static_cast<std::uint64_t>(*first);
    return std::nullopt;
  }

  static std::optional<std::int64_t> number(const Node& node) {
    if (!node.is_scalar() || node.quoted) return std::nullopt;
    const auto parsed = config::parse_count(node.text);
    return parsed ? std::optional{*parsed} : std::nullopt;
  }

  Failure check_size() const {
    std::size_t jobs = grid_.variants.size() * grid_.samples.value_or(1);
    for (const Axis& axis : grid_.axes) {
      if (jobs <= max_jobs_of_all_shards) jobs *= axis.values.size();
    }
    if (jobs <= max_jobs_of_all_shards) return std::nullopt;
    return error_at(root_.place, fmt::format("more than {} jobs; expected at most so many",
                                             max_jobs_of_all_shards));
  }

  const Node& root_;
  const SpecPath& specs_;
  Grid grid_;
  std::optional<Node> base_;
};

}  // namespace

std::size_t Grid::combinations() const {
  std::size_t count = variants.size();
  for (const Axis& axis : axes) count *= axis.values.size();
  return count;
}

Result<Grid> parse_grid(std::string_view text, const std::string& source, const SpecPath& specs) {
  const Result<Node> root = config::parse_yaml(text, source);
  if (!root) return root.error();
  return GridReader{*root, source, specs}.read();
}

Result<Grid> read_grid(const std::string& reference, const SpecPath& specs) {
  const auto file = specs.find(config::SpecKind::grids, reference, "grid");
  if (!file) return file.error();
  const Result<Node> root = config::load_yaml(*file);
  if (!root) return root.error();
  return GridReader{*root, *file, specs}.read();
}

}  // namespace stormproof::grids
