// The reader of scenarios forgets which profiles a scenario was built on, so its `dds:` is resolved
// here once more, with the overrides that choose profiles.
#include "checker/experiments/tune/subject.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "model/config/profile_files.hpp"
#include "model/config/scenario_file.hpp"
#include "model/config/tree/overrides.hpp"
#include "model/config/tree/yaml_text.hpp"
#include "model/config/vendor/vendor_knobs.hpp"

namespace stormproof::tune {

using model::config::InputError;
using model::config::Node;
using model::config::Result;
using model::config::SpecKind;
using model::config::SpecPath;
namespace vendor = model::config::vendor;

namespace {

constexpr const char* dds_key = "dds";

/// "fastdds-2.6.11-sndbuf4M" → "fastdds-2.6.11": without the settings of a user.
std::string version_of(const std::string& preset) {
  const std::size_t product = preset.find('-');
  if (product == std::string::npos) return preset;
  return preset.substr(0, preset.find('-', product + 1));
}

std::vector<std::string> products(const SpecPath& specs) {
  std::vector<std::string> names;
  for (const std::string& name : specs.names(SpecKind::dds)) {
    if (vendor::vendor_of_preset(name) && version_of(name) == name) names.push_back(name);
  }
  return names;
}

/// Puts the overrides of the profile's reference and base into the tree of a scenario.
std::optional<InputError> choose_profile(Node& root, std::span<const std::string> arguments) {
  const auto overrides = model::config::parse_overrides(arguments);
  if (!overrides) return overrides.error();
  const std::string base_path = fmt::format("{}.{}", dds_key, model::config::base_key);
  for (const model::config::Override& change : *overrides) {
    if (change.path != dds_key && change.path != base_path) continue;
    Node* dds = root.find(dds_key);
    if (change.path == base_path && dds != nullptr && dds->is_scalar()) {
      Node map;
      map.kind = Node::Kind::map;
      map.place = dds->place;
      *dds = std::move(map);
    }
    if (auto error = model::config::apply(change, root)) return error;
  }
  return std::nullopt;
}

/// The name of the preset that the scenario's DDS profile is built on; empty if there is none.
Result<std::string> preset_of(const std::string& reference, std::span<const std::string> overrides,
                              const SpecPath& specs) {
  const auto file = specs.find(SpecKind::scenarios, reference, "", reference);
  if (!file) return file.error();
  Result<Node> root = model::config::load_yaml(*file);
  if (!root) return root.error();
  if (auto error = choose_profile(*root, overrides)) return *std::move(error);
  const Node* dds = root->find(dds_key);
  if (dds == nullptr) return std::string{};
  model::config::ProfileOrigin origin;
  const auto resolved = model::config::resolve_profile(*dds, SpecKind::dds, specs, &origin);
  if (!resolved) return resolved.error();
  return origin.preset;
}

}  // namespace

Result<Subject> read_subject(const std::string& reference, std::span<const std::string> overrides,
                             const std::string& preset, const SpecPath& specs) {
  std::vector<std::string> changes{overrides.begin(), overrides.end()};
  if (!preset.empty()) changes.push_back(fmt::format("{}={}", dds_key, preset));
  auto scenario = model::config::read_scenario(reference, changes, specs);
  if (!scenario) return scenario.error();
  const auto name = preset_of(reference, changes, specs);
  if (!name) return name.error();

  Subject subject;
  subject.preset = version_of(*name);
  const auto whose = vendor::vendor_of_preset(subject.preset);
  if (!whose) {
    return InputError{reference,
                      fmt::format("its DDS profile{} is that of no product, so there is nothing "
                                  "that a user could set; tune a library with --preset: {}",
                                  name->empty() ? "" : fmt::format(" '{}'", *name),
                                  fmt::join(products(specs), ", "))};
  }
  subject.vendor = *whose;
  const auto base = model::config::read_dds_profile(subject.preset, {}, specs);
  if (!base) return base.error();
  subject.base = *base;
  subject.scenario = *std::move(scenario);
  if (subject.base.implementation != subject.scenario.dds.implementation) {
    return InputError{reference, fmt::format("its DDS profile '{}' has another implementation than "
                                             "{}; expected one that is built on it, or --preset",
                                             *name, subject.preset)};
  }
  return subject;
}

}  // namespace stormproof::tune
