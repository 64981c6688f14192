// The parts of the HTML page of a comparison that stand in files of their own.
#pragma once

#include <set>
#include <string>

#include "checker/experiments/diff/diff_report.hpp"
#include "checker/presentation/document/drawings.hpp"
#include "checker/presentation/document/html_parts.hpp"

namespace stormproof::diff {

[[nodiscard]] report::Tone tone_of(Judgment judgment);
/// "✗ regression", in its colour.
[[nodiscard]] std::string judgment_badge(Judgment judgment);

/// Plots, crossings and the table of configurations.
[[nodiscard]] std::string costs_html(const DiffReport& report, report::Drawings& drawings);
/// The table of verdicts, and a chart to step through for each that changes.
[[nodiscard]] std::string verdicts_html(const DiffReport& report, const Files& files,
                                        report::Drawings& drawings,
                                        std::set<std::string>& machines);
/// The two runs of the least scenario that tells the profiles apart, one above the other.
[[nodiscard]] std::string apart_html(const DiffReport& report, const Files& files,
                                     report::Drawings& drawings, std::set<std::string>& machines);

}  // namespace stormproof::diff
