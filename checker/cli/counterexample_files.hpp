// The files that a check writes for each violated property: the trace that `replay` runs again, and
// the sequence charts.
#pragma once

#include <optional>
#include <string>

#include "checker/verification/check/check.hpp"
#include "checker/verification/check/check_report.hpp"

namespace stormproof::cli {

/// Writes a text file; what went wrong, or nothing.
[[nodiscard]] std::optional<std::string> write_text(const std::string& path,
                                                    const std::string& text);

/// Writes STEM.jsonl, .svg and .mmd. Returns what could not be written, or nothing.
[[nodiscard]] std::optional<std::string> write_counterexample(
    const props::Counterexample& counterexample, const std::string& stem);

/// Writes PROPERTY.jsonl, .svg and .mmd into the directory, which is made if need be, and notes
/// paths and stories in `context`. Returns what could not be written, or nothing.
[[nodiscard]] std::optional<std::string> write_counterexamples(const std::string& directory,
                                                               const checker::CheckReport& report,
                                                               checker::CheckContext& context);

}  // namespace stormproof::cli
