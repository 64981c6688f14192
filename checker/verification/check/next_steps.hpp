// What to run next, given what the runs of a scenario were like.
#pragma once

#include <string>
#include <vector>

#include "checker/engines/exact/health.hpp"
#include "checker/presentation/document/document.hpp"

namespace stormproof::checker {

/// `words` name the scenario on a command line, with its overrides: "wifi-5x20 --set dds=…".
[[nodiscard]] std::vector<report::NextStep> next_steps(const std::string& words,
                                                       const model::Scenario& scenario,
                                                       const exact::Outlook& outlook);

/// For a command line: the scenario as the user named it, with the overrides.
[[nodiscard]] std::string words_of(const std::string& scenario,
                                   const std::vector<std::string>& overrides);

}  // namespace stormproof::checker
