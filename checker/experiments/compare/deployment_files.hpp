// What a user deploys for a candidate: variables of the environment where ROS 2 reads them, the
// vendor's XML where it does not, and a launch file for one process. Addresses are the user's to
// fill in.
#pragma once

#include <string>
#include <vector>

#include "checker/experiments/compare/candidates.hpp"

namespace stormproof::compare {

struct DeploymentFile {
  std::string name;  ///< "static-peers.xml"
  std::string text;
};

/// Of a candidate with its settings at the scenario's own size, which are `dds`; none for what is
/// skipped, or is what the scenario has and names no product. XML has been read back and gives
/// these settings; otherwise an error.
[[nodiscard]] model::config::Result<std::vector<DeploymentFile>> deployment_files(
    const Candidate& candidate, const model::DdsProfile& dds, const model::config::SpecPath& specs);

}  // namespace stormproof::compare
