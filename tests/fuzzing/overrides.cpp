// Fuzz target: `--set` arguments (model/config/tree/overrides.hpp), one a line, on a shipped
// scenario.
#include <string>
#include <vector>

#include "model/config/scenario_file.hpp"
#include "tests/fuzzing/checks.hpp"
#include "tests/fuzzing/targets.hpp"

namespace stormproof::fuzzing {

Outcome overrides(std::string_view input) {
  if (names_a_device(input)) return Outcome::refused;
  std::vector<std::string> arguments;
  for (std::size_t begin = 0; begin < input.size();) {
    const std::size_t end = std::min(input.find('\n', begin), input.size());
    arguments.emplace_back(input.substr(begin, end - begin));
    begin = end + 1;
  }
  const auto scenario = model::config::read_scenario("smallest", arguments, specs());
  if (!scenario) {
    require(!scenario.error().where.empty(), "an error has a place");
    require(!scenario.error().message.empty(), "an error says what is wrong");
    return Outcome::refused;
  }
  check_scenario(*scenario);
  return Outcome::accepted;
}

}  // namespace stormproof::fuzzing
