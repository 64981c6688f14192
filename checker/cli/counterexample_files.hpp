// The files that a check writes for each violated property: the trace that `replay` runs again, and
// the sequence charts.
#pragma once

#include <optional>
#include <string>

#include "checker/cli/output_folder.hpp"
#include "checker/verification/check/check.hpp"
#include "checker/verification/check/check_report.hpp"

namespace stormproof::cli {

/// Writes NAME.mmd, .svg and .jsonl. The path of the last, the trace, if it was written.
std::optional<std::string> write_counterexample(OutputFolder& folder,
                                                const props::Counterexample& counterexample,
                                                const std::string& name);

/// Writes PROPERTY.mmd, .svg and .jsonl, and notes traces and stories in `context`.
void write_counterexamples(OutputFolder& folder, const checker::CheckReport& report,
                           checker::CheckContext& context);

}  // namespace stormproof::cli
