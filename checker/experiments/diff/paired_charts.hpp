// The two runs of the least scenario that tells two profiles apart, one above the other: the reader
// sees the same rows up to the first difference, and there what each of them does.
#pragma once

#include <string>
#include <string_view>

#include "checker/experiments/diff/diff.hpp"

namespace stormproof::diff {

/// A self-contained SVG document that follows the light or dark preference of its viewer: the run
/// of the base above, the run of the candidate below. Empty if nothing was found. The names are
/// those of the profiles; they may be empty.
[[nodiscard]] std::string paired_charts_svg(const TellingApart& apart,
                                            std::string_view base_name = {},
                                            std::string_view candidate_name = {});

}  // namespace stormproof::diff
