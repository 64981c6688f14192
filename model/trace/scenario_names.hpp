// Names that traces take from the scenario and from the program, rather than from what happens in
// the run.
#pragma once

#include <string>
#include <vector>

#include "model/run_result.hpp"
#include "model/scenario.hpp"

namespace stormproof::model::trace {

/// The channels by number, which is their order of appearance among the stages, for each channel of
/// access points; none with constant delay.
[[nodiscard]] std::vector<std::string> channel_names(const Scenario& scenario);

/// "stormproof 1.2.3": the program that writes the trace.
[[nodiscard]] std::string program_name();

}  // namespace stormproof::model::trace
