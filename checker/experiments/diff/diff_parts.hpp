// The parts of the document of a comparison that stand in files of their own.
#pragma once

#include "checker/experiments/diff/diff_report.hpp"

namespace stormproof::diff {

/// How a judgment looks: "✗ regression".
[[nodiscard]] report::Text badge_of(Judgment judgment);

/// Configurations with what they cost, plots, limits and what was decided together; nothing if
/// nothing had to run.
void add_costs(report::Blocks& blocks, const DiffReport& report);

/// Bars of the completion with the base and with the candidate, for comments on pull requests,
/// which draw nothing; nothing if nothing was run.
void add_comment_chart(report::Blocks& blocks, const DiffReport& report);

/// The configurations in the order in which they are shown: as they were swept if all are,
/// otherwise the worst first.
[[nodiscard]] std::vector<const Configuration*> in_shown_order(const DiffReport& report);
/// So many of them are shown where not everything is.
inline constexpr std::size_t configurations_shown = 16;

/// In which order the hosts of a rolling upgrade go, step by step; nothing if it is none.
void add_rollouts(report::Blocks& blocks, const DiffReport& report);

/// The two runs of the least scenario that tells the profiles apart, or why there is none.
void add_apart(report::Blocks& blocks, const DiffReport& report, const Files& files);

/// What CI systems count and show beside the changed lines.
void add_findings(report::Document& document, const DiffReport& report, const Files& files);

}  // namespace stormproof::diff
