// Environment variables of ROS 2 and of the libraries below it, as far as they decide how nodes
// discover each other: which distributions read them, and what the model does not know of them.
// They are data, in specs/variables.yaml.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "model/config/tree/result.hpp"

namespace stormproof::init {

struct Variable {
  std::string name;                  ///< "ROS_STATIC_PEERS"
  std::string rmw;                   ///< "fastrtps", "cyclonedds" or "any"
  std::vector<std::string> read_by;  ///< distributions: "jazzy"
  std::string source;
  std::vector<std::pair<std::string, std::string>> refuses;  ///< how a value begins, and why not
  std::string remark;                                        ///< may be empty

  [[nodiscard]] bool is_read_by(const std::string& distribution) const;
  /// Why a value, or one of those between its semicolons, is not in the model; empty if it may be.
  [[nodiscard]] std::string why_not(const std::string& value) const;
};

/// What variables.yaml in the first of these folders that has one says, in its order; nothing if
/// none has one. Errors have their place.
[[nodiscard]] model::config::Result<std::vector<Variable>> read_variables(
    const std::vector<std::string>& directories);

}  // namespace stormproof::init
