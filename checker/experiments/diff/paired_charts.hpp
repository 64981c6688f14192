// The two runs of the least scenario that tells two profiles apart: what both begin with is shown
// once or not at all, then what each of them does where they part.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "checker/experiments/diff/diff.hpp"
#include "checker/presentation/sequence/chart.hpp"

namespace stormproof::diff {

struct PairedCharts {
  sequence::Chart base;
  sequence::Chart candidate;
};

/// How much of what both runs begin with the chart of the base has; that of the candidate has the
/// last rows before they part.
enum class CommonStart : std::uint8_t { in_base, nowhere };

/// Of two runs that were told apart. The names are those of the profiles; they may be empty.
[[nodiscard]] PairedCharts paired_charts(const TellingApart& apart, std::string_view base_name,
                                         std::string_view candidate_name, CommonStart start);

/// A self-contained SVG document that follows the light or dark preference of its viewer: the run
/// of the base above, the run of the candidate below. Empty if nothing was found. The names are
/// those of the profiles; they may be empty.
[[nodiscard]] std::string paired_charts_svg(const TellingApart& apart,
                                            std::string_view base_name = {},
                                            std::string_view candidate_name = {});

}  // namespace stormproof::diff
