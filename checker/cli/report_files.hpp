// `--report FORMAT=FILE`: the report of a command in further formats, each in a file. A CI job
// wants several at once, and the work behind them is done only once.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "checker/presentation/document/format.hpp"
#include "model/config/tree/result.hpp"

namespace stormproof::cli {

struct ReportFile {
  report::Format format{};
  std::string path;
};

void add_report_files(CLI::App& command, std::vector<std::string>& arguments);

/// "html=page.html", …; the error of the first that is no such thing.
[[nodiscard]] model::config::Result<std::vector<ReportFile>> parse_report_files(
    const std::vector<std::string>& arguments);

/// Writes each file, as a whole or not at all. Returns what could not be written, or nothing.
[[nodiscard]] std::optional<std::string> write_report_files(
    const std::vector<ReportFile>& files, const std::function<std::string(report::Format)>& render);

}  // namespace stormproof::cli
