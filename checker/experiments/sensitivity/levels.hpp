// What `sensitivity` changes: every number of a scenario, one at a time, by a relative step down
// and up. A knob of the two profiles is changed as `--set` would; the deployment is changed as a
// whole: one participant more or fewer on each host, more or fewer endpoints for all, and starts
// that are further apart or nearer, as `launch` has them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "checker/experiments/trials/launch_plan.hpp"
#include "model/scenario.hpp"

namespace stormproof::sensitivity {

enum class Direction : std::uint8_t { down, up };
inline constexpr std::array<Direction, 2> directions{Direction::down, Direction::up};
[[nodiscard]] const char* name_of(Direction direction);

/// The scenario with one changed value.
struct Level {
  std::string value;  ///< as a file would say it: "1.2s"
  model::Scenario scenario;
  std::optional<launch::Plan> plan;  ///< that processes are started by, if that is what is changed
};

struct Knob {
  std::string key;    ///< "dds.sedp.heartbeat_period"; "deployment.participants", which is no key
  std::string value;  ///< in the scenario
  std::string doc;
  std::array<std::optional<Level>, 2> levels;  ///< by direction; absent: no valid value there
  std::string obstacle;                        ///< why a level is absent; empty if both exist
};

/// All numbers of the scenario, in the order of the tables, the deployment first. `range`, greater
/// than 0 and less than 1, is the relative step; a number of things or nanoseconds changes by at
/// least 1.
[[nodiscard]] std::vector<Knob> knobs_of(const model::Scenario& scenario, double range);

/// Moves the knob `key` of `scenario` as `knobs_of` does, on top of whatever else was changed;
/// nothing if there is no valid value in that direction.
[[nodiscard]] std::optional<Level> moved(const model::Scenario& scenario, const std::string& key,
                                         Direction direction, double range);

}  // namespace stormproof::sensitivity
