// The options that several commands have: the same names and the same words everywhere.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "checker/presentation/document/format.hpp"

namespace stormproof::cli {

/// `--format text|json`.
void add_format(CLI::App& command, bool& json);

/// `--format text|json|markdown|html|junit|sarif`.
void add_format(CLI::App& command, report::Format& format);

/// An option that may be given several times, each time with one value.
CLI::Option* add_repeatable(CLI::App& command, const char* name, std::vector<std::string>& values,
                            const char* help);

/// The scenario, and `--set`.
void add_scenario(CLI::App& command, std::string& scenario, std::vector<std::string>& overrides);

/// `--progress` and `--no-progress`; without them, progress is shown on a terminal.
void add_progress(CLI::App& command, std::optional<bool>& progress);

/// `--timeout` of a solver's queries.
void add_timeout(CLI::App& command, double& seconds);

}  // namespace stormproof::cli
