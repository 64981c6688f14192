// Every knob of a DDS profile with what else could stand there: for whoever asks which knob
// something depends on.
#pragma once

#include <string>
#include <vector>

#include "model/dds_profile.hpp"

namespace stormproof::model::config {

/// A knob of a profile and the profiles that differ in it alone.
struct OtherChoices {
  std::string key;    ///< as `--set` takes it: "dds.sedp.heartbeat_policy"
  std::string value;  ///< what the profile says: "periodic", "0s"
  std::vector<DdsProfile> others;
};

/// All choices of the profile's implementation, each with every other word, and all delays, each
/// with 0 or, if it is 0, with 1 ns; in the order of the tables. What must be positive is left out.
[[nodiscard]] std::vector<OtherChoices> other_choices(const DdsProfile& dds);

}  // namespace stormproof::model::config
