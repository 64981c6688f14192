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
  if (!root) return root.error();
  TracedProfile traced;
  std::optional<InputError> failure;
  read_knobs(*root, "", traced.profile, failure);
  if (failure) return *std::move(failure);
  traced.reference = reference;
  traced.places = places_of(*root);
  traced.preset = std::move(origin.preset);
  traced.vendor = std::move(origin.vendor);
  return traced;
}

Result<TracedScenario> trace_scenario(const std::string& reference,
                                      std::span<const std::string> overrides,
                                      const SpecPath& specs) {
  const Result<Node> root = resolve_scenario(reference, overrides, specs);
  if (!root) return root.error();
  TracedScenario traced;
  std::optional<InputError> failure;
  read_knobs(*root, "", traced.scenario, failure);
  if (failure) return *std::move(failure);
  traced.places = places_of(*root);
  return traced;
}

}  // namespace stormproof::model::config
