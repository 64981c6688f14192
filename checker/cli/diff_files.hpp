// The files that `diff` writes beside its report: both runs of the least scenario that tells the
// profiles apart, as traces that `replay` runs again, as scenarios and as a chart; and the
// counterexamples of changed verdicts.
#pragma once

#include "checker/cli/output_folder.hpp"
#include "checker/experiments/diff/diff_report.hpp"

namespace stormproof::cli {

/// Notes in `files` what was written: "telling-apart.base", "telling-apart.candidate" (traces),
/// "telling-apart.base.scenario", "telling-apart.candidate.scenario", "telling-apart.chart",
/// property ids (traces of counterexamples).
void write_diff_files(OutputFolder& folder, const diff::DiffReport& report, diff::Files& files);

}  // namespace stormproof::cli
