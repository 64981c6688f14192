// The effective scenario: every value that a run really used, after `base:`, `--set` and short
// forms. A report carries it, so that the run can be repeated from the report alone.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "model/scenario.hpp"

namespace stormproof::model::config {

/// deployment (list form), dds (only the keys of its implementation), wireless, time_limit (and
/// run_until, if it is not the usual one), in the syntax of scenario files. JSON is YAML: read back
/// by `parse_scenario`, it gives an equal scenario, for every scenario that a file can describe. A
/// schedule stays beside the times drawn from it; to draw others from the text, take the times out
/// of the participants.
[[nodiscard]] nlohmann::ordered_json effective_json(const Scenario& scenario);
[[nodiscard]] nlohmann::ordered_json effective_json(const DdsProfile& dds);
[[nodiscard]] nlohmann::ordered_json effective_json(const WirelessProfile& wireless);

/// The same as YAML, one key a line.
[[nodiscard]] std::string effective_yaml(const Scenario& scenario);

}  // namespace stormproof::model::config
