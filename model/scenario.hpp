// A scenario: one deployment, one DDS profile, one wireless profile, one time limit. It determines
// one trajectory, to the nanosecond. `model/config/scenario_file.hpp` reads it from YAML.
#pragma once

#include <string>

#include "model/dds_profile.hpp"
#include "model/deployment.hpp"
#include "model/units.hpp"
#include "model/wireless_profile.hpp"

namespace stormproof::model {

struct Scenario {
  Deployment deployment;
  DdsProfile dds;
  WirelessProfile wireless;
  Nanoseconds time_limit{200'000'000'000};  ///< events up to and including this time are processed

  bool operator==(const Scenario&) const = default;
};

}  // namespace stormproof::model
