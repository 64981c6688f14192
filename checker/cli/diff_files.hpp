// The files that `diff` writes beside its report: both runs of the least scenario that tells the
// profiles apart, as traces that `replay` runs again, as scenarios and as a chart; and the
// counterexamples of changed verdicts.
#pragma once

#include <optional>
#include <string>

#include "checker/experiments/diff/diff_report.hpp"

namespace stormproof::cli {

/// Writes into `directory`, which is made if there is anything to write, and notes in `files` what
/// was written: "telling-apart.base", "telling-apart.candidate" (traces),
/// "telling-apart.base.scenario", "telling-apart.candidate.scenario", "telling-apart.chart",
/// property ids (traces of counterexamples). Returns what could not be written, or nothing.
[[nodiscard]] std::optional<std::string> write_diff_files(const std::string& directory,
                                                          const diff::DiffReport& report,
                                                          diff::Files& files);

}  // namespace stormproof::cli
