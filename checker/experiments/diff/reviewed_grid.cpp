// Puts each profile into the place of the grid's own and lets `sweep` plan the jobs, so that a grid
// means the same here as there.
#include "checker/experiments/diff/reviewed_grid.hpp"

#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "checker/experiments/grids/plan.hpp"
#include "model/config/knobs/effective.hpp"
#include "model/config/knobs/knob_reader.hpp"
#include "model/config/tree/yaml_text.hpp"
#include "model/reference.hpp"

namespace stormproof::diff {

namespace config = model::config;
using config::error_at;
using config::InputError;
using config::Node;
using config::Result;
using config::SpecPath;

namespace {

using Failure = std::optional<InputError>;

/// One scenario as a grid.
Result<grids::Grid> read_scenario_grid(const std::string& reference, const SpecPath& specs) {
  const auto file = specs.find(config::SpecKind::scenarios, reference, "", reference);
  if (!file) return file.error();
  Result<Node> root = config::load_yaml(*file);
  if (!root) return root.error();
  grids::Grid grid;
  grid.source = *file;
  grid.variants.push_back({"", *std::move(root), {}});
  return grid;
}

Result<grids::Grid> read_any_grid(const std::string& reference, const SpecPath& specs) {
  if (!config::is_path(reference)) {
    if (specs.named(config::SpecKind::grids, reference)) return grids::read_grid(reference, specs);
    if (specs.named(config::SpecKind::scenarios, reference)) {
      return read_scenario_grid(reference, specs);
    }
    std::error_code failed;
    if (!std::filesystem::exists(reference, failed)) {
      std::vector<std::string> known = specs.names(config::SpecKind::grids);
      for (std::string& name : specs.names(config::SpecKind::scenarios)) known.push_back(name);
      return config::no_such(reference, "grid or scenario", known);
    }
  }
  const Result<Node> root = config::load_yaml(reference);
  if (!root) return root.error();
  const bool is_scenario = root->is_map() && root->find("deployment") != nullptr;
  return is_scenario ? read_scenario_grid(reference, specs) : grids::read_grid(reference, specs);
}

bool is_dds_key(std::string_view key) {
  return key == config::dds_key || key.starts_with(std::string{config::dds_key} + ".");
}

/// The two profiles take the place of `dds`, so a grid that varies it cannot be meant.
Failure varied_profile(const grids::Grid& grid) {
  constexpr const char* expected =
      "expected a grid that leaves the DDS profile alone, because the "
      "two profiles take its place";
  for (const grids::Axis& axis : grid.axes) {
    if (!is_dds_key(axis.key)) continue;
    return error_at(axis.values.front().node.place,
                    fmt::format("{}: the grid sweeps the DDS profile; {}", axis.key, expected));
  }
  for (const grids::Variant& variant : grid.variants) {
    for (const config::Override& change : variant.overrides) {
      if (!is_dds_key(change.path)) continue;
      return error_at(change.value.place,
                      fmt::format("{}: one of the scenarios changes the DDS profile; {}",
                                  change.path, expected));
    }
  }
  return std::nullopt;
}

/// The grid's plan with `profile` as the DDS profile of all scenarios.
Result<grids::Plan> plan_with(grids::Grid grid, const model::DdsProfile& profile,
                              const SpecPath& specs) {
  const std::string text = config::effective_json(profile).dump();
  for (grids::Variant& variant : grid.variants) {
    Result<Node> dds = config::parse_yaml(text, grid.source);
    if (!dds) return dds.error();
    Node* present = variant.root.find(config::dds_key);
    if (present != nullptr) {
      *present = *std::move(dds);
    } else {
      variant.root.members.push_back(
          {std::string{config::dds_key}, variant.root.place, *std::move(dds)});
    }
  }
  Result<grids::Plan> plan = grids::make_plan(std::move(grid), specs);
  if (!plan) return plan;
  for (std::size_t job = 0; job < plan->size(); ++job) {
    if (const auto& error = plan->error(job)) return *error;
  }
  return plan;
}

Result<std::vector<std::optional<model::Limits>>> limits_of(const grids::Grid& grid) {
  std::vector<std::optional<model::Limits>> all;
  for (const grids::Variant& variant : grid.variants) {
    const Node* node = variant.root.find("limits");
    all.emplace_back();
    if (node == nullptr) continue;
    Failure failure;
    config::read_knobs(*node, "limits", all.back().emplace(), failure);
    if (failure) return *std::move(failure);
  }
  return all;
}

/// "participants_per_host 5, endpoints_per_participant 20": the last word of a key says enough
/// unless two keys end alike.
std::string short_key(const std::string& key, const std::vector<std::string>& keys) {
  const std::string last = key.substr(key.rfind('.') + 1);
  int alike = 0;
  for (const std::string& other : keys) alike += other.substr(other.rfind('.') + 1) == last ? 1 : 0;
  return alike > 1 ? key : last;
}

}  // namespace

std::uint64_t load_of(const ReviewedPoint& point) {
  return model::failure_free_reference(point.base).initial_data;
}

Result<ReviewedGrid> read_reviewed_grid(const std::string& reference, const model::DdsProfile& base,
                                        const model::DdsProfile& candidate, const SpecPath& specs) {
  Result<grids::Grid> grid = read_any_grid(reference, specs);
  if (!grid) return grid.error();
  if (auto failure = varied_profile(*grid)) return *std::move(failure);
  const auto limits = limits_of(*grid);
  if (!limits) return limits.error();
  ReviewedGrid reviewed{reference, {}, grid->samples, grid->first_seed};
  grid->samples.reset();  // schedules are drawn here, because they may have to be more
  const auto before = plan_with(*grid, base, specs);
  if (!before) return before.error();
  const auto after = plan_with(*grid, candidate, specs);
  if (!after) return after.error();

  const std::vector<std::string> keys = before->keys();
  const std::size_t jobs_of_variant = before->size() / grid->variants.size();
  for (std::size_t job = 0; job < before->size(); ++job) {
    ReviewedPoint point;
    const std::vector<std::string> values = before->values(job);
    for (std::size_t k = 0; k < keys.size(); ++k) {
      point.values.emplace_back(keys[k], values[k]);
      point.name += fmt::format("{}{} {}", k == 0 ? "" : ", ", short_key(keys[k], keys), values[k]);
    }
    if (point.name.empty()) point.name = reference;
    point.base = before->scenario(job);
    point.candidate = after->scenario(job);
    point.limits = (*limits)[job / jobs_of_variant];
    reviewed.points.push_back(std::move(point));
  }
  return reviewed;
}

}  // namespace stormproof::diff
