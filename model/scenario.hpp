// A scenario: one deployment, one DDS profile, one wireless profile, one time limit. It determines
// one trajectory, to the nanosecond. `model/config/scenario_file.hpp` reads it from YAML.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "model/dds_profile.hpp"
#include "model/deployment.hpp"
#include "model/limits.hpp"
#include "model/units.hpp"
#include "model/wireless_profile.hpp"

namespace stormproof::model {

/// What ends a run: the completion of discovery, in the middle of the packet that completes it, or
/// the time limit alone, so that what follows discovery is part of the run.
enum class RunUntil : std::uint8_t { completion, time_limit };

struct Scenario {
  Deployment deployment;
  DdsProfile dds;
  WirelessProfile wireless;
  Nanoseconds time_limit{200'000'000'000};  ///< events up to and including this time are processed
  RunUntil run_until = RunUntil::completion;
  std::optional<Limits> limits;   ///< what the author demands; they change no run
  std::optional<Variation> vary;  ///< ranges for `stormproof fuzz`; they change no run

  bool operator==(const Scenario&) const = default;
};

}  // namespace stormproof::model
