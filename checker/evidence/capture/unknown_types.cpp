// Types by name, of endpoints that announce them.
#include "checker/evidence/capture/unknown_types.hpp"

#include <algorithm>
#include <set>
#include <string>

namespace stormproof::capture {

namespace {

/// Of a participant: which SEDP writer announced an endpoint of which type.
std::set<std::pair<EntityId, std::string>> looked_up(const Participant& participant) {
  std::set<std::pair<EntityId, std::string>> types;
  for (const auto& [guid, endpoint] : participant.endpoints) {
    if (endpoint.has_type_information) types.emplace(endpoint.announced_by, endpoint.type);
  }
  return types;
}

std::set<std::string> types_of(const Participant& participant) {
  std::set<std::string> types;
  for (const auto& [guid, endpoint] : participant.endpoints) types.insert(endpoint.type);
  return types;
}

}  // namespace

UnknownTypes unknown_types(const Topology& topology) {
  const auto& list = topology.participants;
  const auto across = [&list](std::size_t one) {
    return static_cast<std::uint64_t>(std::ranges::count_if(
        list, [&](const Participant& other) { return other.host != list[one].host; }));
  };
  std::vector<std::set<std::string>> types;
  for (const Participant& one : list) types.push_back(types_of(one));
  UnknownTypes found;
  std::uint64_t for_one_each = 0;
  std::vector<std::set<std::pair<EntityId, std::string>>> asked(list.size());
  for (std::size_t owner = 0; owner < list.size(); ++owner) {
    std::set<std::string> alone;
    for (std::size_t j = 0; j < list.size(); ++j) {
      if (j != owner) for_one_each += 2 * (across(j) + across(owner));
    }
    for (const auto& [stream, type] : looked_up(list[owner])) {
      found.can_be_looked_up = true;
      bool is_alone = true;
      for (std::size_t j = 0; j < list.size(); ++j) {
        if (j == owner) continue;
        is_alone = is_alone && !types[j].contains(type);
        if (types[j].contains(type) || !asked[j].emplace(stream, type).second) continue;
        found.lookups += 2 * (across(j) + across(owner));
      }
      if (is_alone) alone.insert(type);
    }
    found.most_of_a_participant = std::max(found.most_of_a_participant, alone.size());
  }
  if (for_one_each > 0) {
    found.per_participant =
        static_cast<std::uint32_t>((found.lookups + for_one_each / 2) / for_one_each);
  }
  return found;
}

}  // namespace stormproof::capture
