// Names of ROS 2 distributions as names of DDS profiles. Who runs a robot knows that it is a
// Humble, not which version of Fast DDS that means; specs/distributions.yaml says which shipped
// profile stands for it, which version the distribution really ships, and how the two differ.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/config/tree/result.hpp"

namespace stormproof::model::config {

struct Distribution {
  std::string name;     ///< "humble"
  std::string ships;    ///< "Fast DDS 2.6.12"
  std::string profile;  ///< "fastdds-2.6.11", a name in specs/dds
  std::string why;      ///< what was compared, in half a sentence
  std::string source;   ///< the file that says so
};

/// Whether the profile is of another version than the one that is shipped.
[[nodiscard]] bool stands_in(const Distribution& distribution);

/// "ROS 2 humble ships Fast DDS 2.6.12; fastdds-2.6.11 stands for it: …".
[[nodiscard]] std::string statement_of(const Distribution& distribution);

/// Which library a distribution runs on.
enum class Rmw : std::uint8_t {
  of_the_distribution,  ///< rmw_fastrtps_cpp
  cyclonedds            ///< rmw_cyclonedds_cpp, which its users choose
};

/// What distributions.yaml in the first of these folders that has one says, in its order; nothing
/// if none has one. Errors, with their place: what is not a map of names to `ships`, `profile` and
/// `why`, all of them text. Whether there is such a profile is not asked.
[[nodiscard]] Result<std::vector<Distribution>> read_distributions(
    const std::vector<std::string>& directories, Rmw rmw = Rmw::of_the_distribution);

/// The name of the profile that stands in the place of one that is not shipped any more, by the
/// same file; empty if it says nothing of this name. Errors as above.
[[nodiscard]] Result<std::string> successor_of(const std::vector<std::string>& directories,
                                               const std::string& name);

}  // namespace stormproof::model::config
