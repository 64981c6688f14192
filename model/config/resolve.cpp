// Resolving goes in four steps: text to tree, overrides that choose profiles, profiles resolved
// with their bases, overrides of single keys.
#include "model/config/resolve.hpp"

#include <fmt/core.h>

#include "model/config/knobs/dds_knobs.hpp"
#include "model/config/knobs/scenario_knobs.hpp"
#include "model/config/tree/overrides.hpp"
#include "model/config/tree/yaml_text.hpp"
#include "model/config/vendor/reference.hpp"

namespace stormproof::model::config {
namespace {

struct ProfileSlot {
  std::string_view key;  ///< in the scenario
  SpecKind kind;
};
constexpr ProfileSlot profile_slots[] = {{dds_key, SpecKind::dds},
                                         {wireless_key, SpecKind::wireless}};

/// Whether `path` goes below the profile in `slot`; `rest` is then the path inside the profile.
bool is_below(std::string_view path, const ProfileSlot& slot, std::string_view& rest) {
  if (!path.starts_with(slot.key) || path.substr(slot.key.size(), 1) != ".") return false;
  rest = path.substr(slot.key.size() + 1);
  return true;
}

/// Whether an override is about one key of a resolved profile, so that it has to wait for the
/// profile.
bool is_about_profile_key(const Override& change) {
  std::string_view rest;
  for (const ProfileSlot& slot : profile_slots) {
    if (is_below(change.path, slot, rest)) return rest != base_key;
  }
  return false;
}

/// A profile given by name or path becomes a map with that base, so that overrides can reach into
/// it.
void make_map(Node& profile) {
  if (!profile.is_scalar()) return;
  Node map;
  map.kind = Node::Kind::map;
  map.place = profile.place;
  map.members.push_back({std::string{base_key}, profile.place, std::move(profile)});
  profile = std::move(map);
}

using Failure = std::optional<InputError>;

Failure choose_profiles(Node& root, const std::vector<Override>& overrides) {
  for (const Override& change : overrides) {
    if (is_about_profile_key(change)) continue;
    std::string_view rest;
    for (const ProfileSlot& slot : profile_slots) {
      Node* profile = root.find(slot.key);
      if (profile != nullptr && is_below(change.path, slot, rest)) make_map(*profile);
    }
    if (Failure failure = apply(change, root)) return failure;
  }
  return std::nullopt;
}

Failure resolve_profiles(Node& root, const SpecPath& specs) {
  for (const ProfileSlot& slot : profile_slots) {
    Node* profile = root.find(slot.key);
    if (profile == nullptr) continue;
    Result<Node> resolved = resolve_profile(std::move(*profile), slot.kind, specs);
    if (!resolved) return resolved.error();
    *profile = *std::move(resolved);
  }
  return std::nullopt;
}

/// Applies an override of one key of a resolved profile. Paths below `dds`, the DDS profile if
/// there is one, start with `prefix`.
Failure change_dds_key(const Override& change, std::string_view prefix, const Node* dds,
                       Node& root) {
  const bool is_implementation =
      change.path.starts_with(prefix) && change.path.substr(prefix.size()) == implementation_key;
  if (is_implementation && dds != nullptr) {
    if (Failure failure = check_implementation(*dds, &change.value)) return failure;
  }
  return apply(change, root);
}

Failure change_profile_keys(Node& root, const std::vector<Override>& overrides) {
  const std::string prefix = fmt::format("{}.", dds_key);
  for (const Override& change : overrides) {
    if (!is_about_profile_key(change)) continue;
    if (Failure failure = change_dds_key(change, prefix, root.find(dds_key), root)) return failure;
  }
  return std::nullopt;
}

Result<Node> resolve_tree(Node root, std::span<const std::string> arguments,
                          const SpecPath& specs) {
  const auto overrides = parse_overrides(arguments);
  if (!overrides) return overrides.error();
  if (!root.is_map()) return root;  // what is wrong with it is for the tables to say
  Failure failure = choose_profiles(root, *overrides);
  if (!failure) failure = drop_description(root);
  if (!failure) failure = resolve_profiles(root, specs);
  if (!failure) failure = change_profile_keys(root, *overrides);
  if (failure) return *std::move(failure);
  return root;
}

/// A scenario's name that is a vendor's file is a natural mistake with a simple remedy.
Failure refuse_vendor_file(const std::string& reference) {
  if (!vendor::parse_reference(reference)) return std::nullopt;
  return InputError{reference,
                    fmt::format("a DDS vendor's XML file is a profile; expected a scenario, which "
                                "takes it with --set dds={}",
                                reference)};
}

}  // namespace

Result<Node> resolve_scenario_text(std::string_view text, const std::string& source,
                                   std::span<const std::string> overrides, const SpecPath& specs) {
  Result<Node> root = parse_yaml(text, source);
  if (!root) return root;
  return resolve_tree(*std::move(root), overrides, specs);
}

Result<Node> resolve_scenario(const std::string& reference, std::span<const std::string> overrides,
                              const SpecPath& specs) {
  if (Failure failure = refuse_vendor_file(reference)) return *std::move(failure);
  const auto file = specs.find(SpecKind::scenarios, reference, "", reference);
  if (!file) return file.error();
  Result<Node> root = load_yaml(*file);
  if (!root) return root;
  return resolve_tree(*std::move(root), overrides, specs);
}

Result<Node> resolve_profile(const std::string& reference, SpecKind kind,
                             std::span<const std::string> arguments, const SpecPath& specs,
                             ProfileOrigin* origin, Outside outside) {
  const auto overrides = parse_overrides(arguments);
  if (!overrides) return overrides.error();
  Node name;
  name.kind = Node::Kind::scalar;
  name.text = reference;
  name.place.source = std::make_shared<const std::string>(reference);
  Result<Node> root = resolve_profile(std::move(name), kind, specs, origin, outside);
  if (!root) return root;
  const Node* dds = kind == SpecKind::dds ? &*root : nullptr;
  for (const Override& change : *overrides) {
    if (Failure failure = change_dds_key(change, "", dds, *root)) return *std::move(failure);
  }
  return root;
}

}  // namespace stormproof::model::config
