// The formats of an answer: `--format` and `--report FORMAT=FILE`. A CI job wants several at once,
// and the work behind them is done only once.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "checker/cli/output_file.hpp"
#include "checker/presentation/document/format.hpp"
#include "model/config/tree/result.hpp"

namespace stormproof::cli {

/// A format under its name.
using NamedFormat = std::pair<std::string, report::Format>;

struct ReportFile {
  ReportFile(report::Format of, std::string at) : format{of}, path{std::move(at)} {}

  report::Format format;
  std::string path;
  OutputFile file{};
};

/// "html=page.html", …; the error of the first that is no such thing.
[[nodiscard]] std::optional<model::config::InputError> parse_report_files(
    const std::vector<std::string>& arguments, std::span<const NamedFormat> offered,
    std::deque<ReportFile>& files);

}  // namespace stormproof::cli
