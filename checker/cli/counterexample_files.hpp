// The files that a check writes for each violated property: the trace that `replay` runs again, the
// sequence charts, and the GoogleTest cases.
#pragma once

#include <optional>
#include <string>

#include "checker/cli/check_command.hpp"
#include "checker/verification/check/check.hpp"
#include "checker/verification/check/check_report.hpp"

namespace stormproof::cli {

/// Writes a text file; what went wrong, or nothing.
[[nodiscard]] std::optional<std::string> write_text(const std::string& path,
                                                    const std::string& text);

/// Writes STEM.jsonl, .svg and .mmd. Returns what could not be written, or nothing.
[[nodiscard]] std::optional<std::string> write_counterexample(
    const props::Counterexample& counterexample, const std::string& stem);

/// Writes PROPERTY.jsonl, .svg and .mmd into the output directory and notes paths and stories in
/// `context`. Returns what could not be written, or nothing.
[[nodiscard]] std::optional<std::string> write_counterexamples(const CheckArguments& arguments,
                                                               const checker::CheckReport& report,
                                                               checker::CheckContext& context);

}  // namespace stormproof::cli
