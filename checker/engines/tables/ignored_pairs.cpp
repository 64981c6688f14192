// Reads the embedded list.
#include "checker/engines/tables/ignored_pairs.hpp"

#include <yaml-cpp/yaml.h>

namespace stormproof::tables {

IgnoredPairs ignored_pairs(std::string_view machine) {
  IgnoredPairs pairs;
  const YAML::Node file = YAML::Load(ignored_pairs_text);
  const YAML::Node sections = file["machines"][std::string{machine}];
  for (const char* const key : {"no_row", "guards_reject"}) {
    const bool no_row = std::string_view{key} == "no_row";
    for (const YAML::Node& group : sections[key]) {
      for (const YAML::Node& event : group["events"]) {
        const IgnoredPairs::Pair pair{group["state"].as<std::string>(), event.as<std::string>()};
        (no_row ? pairs.no_row : pairs.guards_reject).insert(pair);
        if (no_row && !group["occurs"].as<bool>()) pairs.never_occur.push_back(pair);
      }
    }
  }
  return pairs;
}

}  // namespace stormproof::tables
