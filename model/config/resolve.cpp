// Overrides that choose a profile come before the profile, those of single keys after it.
#include "model/config/resolve.hpp"

#include <map>
#include <utility>

#include <fmt/core.h>

#include "model/config/knobs/dds_knobs.hpp"
#include "model/config/knobs/scenario_knobs.hpp"

namespace stormproof::model::config {
namespace {

struct ProfileSlot {
  std::string_view key;  ///< in the scenario
  SpecKind kind;
};
constexpr ProfileSlot profile_slots[] = {
    {dds_key, SpecKind::dds}, {wireless_key, SpecKind::wireless}, {hosts_key, SpecKind::hosts}};

/// What `path` is inside the profile in `slot`; nothing if it does not go below it.
std::optional<std::string_view> path_below(const ProfileSlot& slot, std::string_view path) {
  if (!path.starts_with(slot.key) || path.substr(slot.key.size(), 1) != ".") return std::nullopt;
  return path.substr(slot.key.size() + 1);
}

/// A profile given by name or path becomes a map with that base, so that overrides can reach into
/// it.
void make_map(Node& profile) {
  if (!profile.is_scalar()) return;
  Node map = Node::map(profile.place);
  map.members.push_back({std::string{base_key}, profile.place, std::move(profile)});
  profile = std::move(map);
}

using Failure = std::optional<InputError>;

/// What a host or a participant of the deployment is, and the profile that it may have.
constexpr std::string_view deployment_key = "deployment";
constexpr std::string_view lists_with_profiles[] = {participants_key, hosts_key};

/// Calls `visit` with each profile of a host or a participant, and its path.
template <class Visit>
void for_own_profiles(Node& root, Visit&& visit) {
  Node* deployment = root.find(deployment_key);
  if (deployment == nullptr || !deployment->is_map()) return;
  for (const std::string_view key : lists_with_profiles) {
    Node* list = deployment->find(key);
    if (list == nullptr || !list->is_sequence()) continue;
    for (std::size_t k = 0; k < list->items.size(); ++k) {
      Node* own = list->items[k].is_map() ? list->items[k].find(own_profile_key) : nullptr;
      if (own == nullptr) continue;
      visit(*own, fmt::format("{}.{}.{}.{}", deployment_key, key, k, own_profile_key));
    }
  }
}

/// An error if the two are not of one implementation; whatever else keeps them apart the tables
/// say.
Failure check_beside(const Node& whole, const Node& own, const Place& place,
                     const std::string& path) {
  const std::string_view expected = implementation_of(whole);
  const std::string_view word = implementation_of(own);
  if (word == expected) return std::nullopt;
  return error_at(place, fmt::format("{}: a profile with {}: {}; expected one with {}: {}, as the "
                                     "scenario's has it: what the two make of each other nobody "
                                     "has stated",
                                     path, implementation_key, word, implementation_key, expected));
}

/// Of hosts and participants.
Failure resolve_own_profiles(Node& root, const SpecPath& specs) {
  Failure failure;
  std::map<std::pair<std::string, std::string>, Node> known;  // by file and name in it
  const Node* whole = root.find(dds_key);
  for_own_profiles(root, [&](Node& own, const std::string& path) {
    if (failure) return;
    const Place place = own.place;
    const std::pair key{place.source == nullptr ? std::string{} : *place.source, own.text};
    const auto before = own.is_scalar() ? known.find(key) : known.end();
    if (before != known.end()) {
      own = before->second;
    } else {
      const bool is_name = own.is_scalar();
      Result<Resolved> complete = resolve_profile(std::move(own), SpecKind::dds, specs);
      if (!complete) {
        failure = complete.error();
        return;
      }
      own = std::move(complete->tree);
      if (is_name) known.emplace(key, own);
    }
    own.place = place;
    if (whole != nullptr && whole->is_map()) failure = check_beside(*whole, own, place, path);
  });
  return failure;
}

/// Applies an override of a key of a resolved profile. Paths inside `dds`, the DDS profile if there
/// is one, start with `prefix`.
Failure change_key(const Override& change, std::string_view prefix, const Node* dds, Node& root) {
  if (dds != nullptr && change.path == fmt::format("{}{}", prefix, implementation_key)) {
    if (Failure failure = check_implementation(*dds, &change.value)) return failure;
  }
  return apply(change, root);
}

}  // namespace

namespace {

/// Puts in what the preset with a server says and the profile does not.
Failure complete_with_server(Node* dds, const std::string& preset, const SpecPath& specs) {
  const Node* way = dds == nullptr || !dds->is_map() ? nullptr : dds->find(discovery_key);
  if (way == nullptr || (way->text != "server" && way->text != "super_client")) return std::nullopt;
  const auto name = preset_with(preset, "server", specs);
  if (!name) return std::nullopt;
  auto server =
      resolve_profile(Node::scalar(way->place, *name), SpecKind::dds, specs, Outside::refused);
  if (!server) return server.error();
  for (Member& member : server->tree.members) {
    if (dds->find(member.key) == nullptr) dds->members.push_back(std::move(member));
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> preset_with(const std::string& preset, std::string_view way,
                                       const SpecPath& specs) {
  const std::size_t version = preset.find('-') + 1;
  const bool has_version =
      version > 0 && version < preset.size() && preset[version] >= '0' && preset[version] <= '9';
  if (!has_version) return std::nullopt;
  const std::string name =
      fmt::format("{}{}-{}", preset.substr(0, version), way, preset.substr(version));
  if (!specs.named(SpecKind::dds, name)) return std::nullopt;
  return name;
}

bool is_profile_key(std::string_view path) {
  for (const ProfileSlot& slot : profile_slots) {
    if (const auto key = path_below(slot, path)) return *key != base_key;
  }
  return false;
}

Result<Resolved> with_profiles(Node scenario, Overrides overrides, const SpecPath& specs,
                               std::string_view implementation) {
  Resolved resolved{std::move(scenario)};
  Node& root = resolved.tree;
  if (!root.is_map()) return resolved;  // what is wrong with it is for the tables to say
  for (const Override& change : overrides) {
    if (is_profile_key(change.path)) continue;
    for (const ProfileSlot& slot : profile_slots) {
      Node* profile = root.find(slot.key);
      if (profile != nullptr && path_below(slot, change.path)) make_map(*profile);
    }
    for_own_profiles(root, [&](Node& own, const std::string& path) {
      if (change.path.starts_with(path + ".")) make_map(own);
    });
    if (Failure failure = apply(change, root)) return *std::move(failure);
  }
  if (Failure failure = drop_description(root)) return *std::move(failure);
  for (const auto& [key, kind] : profile_slots) {
    Node* profile = root.find(key);
    if (profile == nullptr) continue;
    const Node* dds = root.find(dds_key);
    const bool is_known = kind == SpecKind::wireless && dds != nullptr && dds->is_map();
    Result<Resolved> complete =
        resolve_profile(std::move(*profile), kind, specs, Outside::refused,
                        is_known ? implementation_of(*dds) : implementation);
    if (!complete) return complete;
    *profile = std::move(complete->tree);
    if (kind != SpecKind::dds) continue;
    resolved.preset = std::move(complete->preset);
    resolved.vendor = std::move(complete->vendor);
  }
  if (Failure failure = resolve_own_profiles(root, specs)) return *std::move(failure);
  return resolved;
}

Result<Resolved> with_profile_keys(Result<Resolved> scenario, Overrides overrides,
                                   const SpecPath& specs) {
  if (!scenario || !scenario->tree.is_map()) return scenario;
  Node& root = scenario->tree;
  const std::string prefix = fmt::format("{}.", dds_key);
  for (const Override& change : overrides) {
    if (!is_profile_key(change.path)) continue;
    Failure failure = change_key(change, prefix, root.find(dds_key), root);
    if (failure) return *std::move(failure);
  }
  if (Failure failure = complete_with_server(root.find(dds_key), scenario->preset, specs)) {
    return *std::move(failure);
  }
  return scenario;
}

Result<Resolved> with_keys(Result<Resolved> profile, SpecKind kind, Overrides overrides,
                           const SpecPath& specs) {
  if (!profile) return profile;
  Node& root = profile->tree;
  for (const Override& change : overrides) {
    Failure failure = change_key(change, "", kind == SpecKind::dds ? &root : nullptr, root);
    if (failure) return *std::move(failure);
  }
  if (kind != SpecKind::dds) return profile;
  if (Failure failure = complete_with_server(&root, profile->preset, specs)) {
    return *std::move(failure);
  }
  return profile;
}

}  // namespace stormproof::model::config
