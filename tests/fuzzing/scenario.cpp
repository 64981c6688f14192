// Fuzz target: scenario files (model/config/scenario_file.hpp).
#include "model/config/scenario_file.hpp"
#include "tests/fuzzing/checks.hpp"
#include "tests/fuzzing/targets.hpp"

namespace stormproof::fuzzing {

Outcome scenario(std::string_view input) {
  if (names_a_device(input)) return Outcome::refused;
  const auto scenario = model::config::parse_scenario(input, "input", {}, specs());
  if (!scenario) {
    require(scenario.error().where.starts_with("input") || !scenario.error().where.empty(),
            "an error has a place");
    require(!scenario.error().message.empty(), "an error says what is wrong");
    return Outcome::refused;
  }
  check_scenario(*scenario);
  return Outcome::accepted;
}

}  // namespace stormproof::fuzzing
