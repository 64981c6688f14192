// Where reports about a check point for a property: the line of the user's own
// file that it is about.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "checker/presentation/document/document.hpp"
#include "model/config/tree/tree.hpp"
#include "props/property.hpp"

namespace stormproof::checker {

/// Keys of the scenario that decide whether the property holds, the one that usually does first.
/// Empty if none does: the property is about the rules themselves.
[[nodiscard]] std::vector<std::string_view> knobs_of(std::string_view property);

/// Whether the user wrote it: on the command line, in the scenario `own_file`, or in any file that
/// is not a shipped profile.
[[nodiscard]] bool by_user(const model::config::Place& place, const std::string& own_file);

/// The file of the scenario; the reference itself if that is not known.
[[nodiscard]] std::string scenario_file(const model::config::Places& places,
                                        const std::string& reference);

/// The first knob of the property that the user's own file sets; otherwise the DDS profile in the
/// scenario; otherwise the scenario.
[[nodiscard]] report::Location location_of(std::string_view property,
                                           const model::config::Places& places,
                                           const std::string& reference);

/// "file:12", "--set …", or "–".
[[nodiscard]] std::string origin_text(const model::config::Place& place);

}  // namespace stormproof::checker
