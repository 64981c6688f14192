// Reads like scenario_file.cpp, and keeps what that throws away: the places of the resolved tree,
// and the chain of files that it came from.
#include "model/config/provenance.hpp"

#include <fmt/format.h>

#include "model/config/knobs/knob_reader.hpp"
#include "model/config/resolve.hpp"

namespace stormproof::model::config {
namespace {

void collect(const Node& node, const std::string& key, Places& places) {
  if (!key.empty()) places.emplace(key, node.place);
  for (const Member& member : node.members) {
    collect(member.value, join_path(key, member.key), places);
  }
  for (std::size_t k = 0; k < node.items.size(); ++k) {
    collect(node.items[k], join_path(key, fmt::to_string(k)), places);
  }
}

}  // namespace

Places places_of(const Node& tree, const std::string& prefix) {
  Places places;
  std::string key = prefix;
  while (key.ends_with('.')) key.pop_back();
  collect(tree, key, places);
  return places;
}

Result<TracedProfile> trace_dds_profile(const std::string& reference,
                                        std::span<const std::string> overrides,
                                        const SpecPath& specs, Outside outside) {
  ProfileOrigin origin;
  const Result<Node> root =
      resolve_profile(reference, SpecKind::dds, overrides, specs, &origin, outside);
  auto profile = checked<DdsProfile>(root);
  if (!profile) return profile.error();
  return TracedProfile{reference, *std::move(profile), places_of(*root), std::move(origin.preset),
                       std::move(origin.vendor)};
}

Result<TracedScenario> trace_scenario(const std::string& reference,
                                      std::span<const std::string> overrides,
                                      const SpecPath& specs) {
  const Result<Node> root = resolve_scenario(reference, overrides, specs);
  auto scenario = checked<Scenario>(root);
  if (!scenario) return scenario.error();
  return TracedScenario{*std::move(scenario), places_of(*root)};
}

}  // namespace stormproof::model::config
