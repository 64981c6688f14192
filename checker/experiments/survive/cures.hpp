// What is known to help where a failure is not survived, with who says so: settings that the
// library's users can make, and versions. Whether it does here is tried, not believed.
#pragma once

#include <string>
#include <vector>

#include "model/scenario.hpp"

namespace stormproof::survive {

struct Cure {
  std::string name;                    ///< "SPDPInterval 5 s"
  std::vector<std::string> overrides;  ///< of the scenario: "dds.spdp.period=5s"
  std::string source;                  ///< whose change or setting it is, and where it is explained
};

/// Those that differ from the scenario.
[[nodiscard]] std::vector<Cure> cures_for(const model::Scenario& scenario);

}  // namespace stormproof::survive
