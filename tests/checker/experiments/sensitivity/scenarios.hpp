// Scenarios of the sensitivity tests: a shipped one with changes.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "model/config/scenario_file.hpp"

namespace stormproof::sensitivity {

inline model::Scenario scenario_with(const std::vector<std::string>& changes) {
  const model::config::SpecPath specs{{STORMPROOF_SPECS_DIR}};
  auto scenario = model::config::read_scenario("smallest", changes, specs);
  if (!scenario) {
    ADD_FAILURE() << to_string(scenario.error());
    return {};
  }
  return *std::move(scenario);
}

}  // namespace stormproof::sensitivity
