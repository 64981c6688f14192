// What the environment of a process that runs ROS 2 says of how its nodes discover each other.
#pragma once

#include <functional>

#include "checker/evidence/init/draft.hpp"

namespace stormproof::init {

/// `system` with what ROS_DISTRO, RMW_IMPLEMENTATION and the variables of specs/variables.yaml say,
/// each as far as that distribution and RMW read it. Of what they do not read, and of what the
/// scenario does not say, there is a remark. `value_of` gives a variable's value, or null.
/// Errors: an RMW that nobody knows; a value with which nobody on other hosts is discovered, or
/// that means what is not in the model.
[[nodiscard]] model::config::Result<System> from_environment(
    System system, const std::function<const char*(const char*)>& value_of,
    const model::config::SpecPath& specs);

}  // namespace stormproof::init
