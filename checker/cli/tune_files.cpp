// All texts are made, and read back, before the first file is written.
#include "checker/cli/tune_files.hpp"

#include <filesystem>

#include <fmt/core.h>

#include "checker/cli/output_file.hpp"
#include "checker/experiments/tune/deploy.hpp"

namespace stormproof::cli {

namespace {

namespace fs = std::filesystem;
using model::config::InputError;
using model::config::SpecPath;

bool is_one_file(const std::string& output) { return output.ends_with(".xml"); }

/// What stands at the top of a written file.
std::string comment_of(const TuneOutput& output, const tune::Subject& subject, const tune::Row& row,
                       const std::vector<std::string>& prerequisites) {
  std::string text = fmt::format("Settings for {}, chosen by stormproof tune on {} (seed {}).",
                                 subject.preset, output.scenario, output.seed);
  if (row.summary.completion_ns.median) {
    text += fmt::format(" Predicted: completion {:.3f} s, {:.0f} messages (medians).",
                        *row.summary.completion_ns.median / 1e9,
                        row.summary.messages.median.value_or(0));
  }
  for (const std::string& what : prerequisites) text += " " + what;
  return text;
}

/// "recommended.xml", "front-2.xml"; with one file, its name.
std::string file_of(const std::string& output, const tune::Row& row, bool is_recommended) {
  if (is_one_file(output)) return output;
  std::string name = row.name;
  if (const std::size_t space = name.find(' '); space != std::string::npos) name[space] = '-';
  return (fs::path{output} / (is_recommended ? "recommended.xml" : name + ".xml")).string();
}

}  // namespace

TuneFiles write_files(const TuneOutput& wanted, const tune::Subject& subject,
                      const tune::Report& report) {
  TuneFiles written;
  const std::string& output = wanted.path;
  const bool better = report.answer == tune::Answer::better;
  if (output.empty() || report.answer == tune::Answer::interrupted) return written;
  std::vector<std::pair<std::string, std::string>> texts;  // path, XML
  for (std::size_t k = 0; k < report.rows.size(); ++k) {
    const tune::Row& row = report.rows[k];
    const bool is_recommended = better && report.recommended == k;
    if (row.kind != tune::Row::Kind::front || (is_one_file(output) && !is_recommended)) continue;
    const model::DdsProfile& profile = row.scenario.dds;
    const auto needs = tune::prerequisites(subject, profile);
    const auto xml = tune::deployable(subject, profile, comment_of(wanted, subject, row, needs),
                                      SpecPath::standard());
    if (!xml) return {{}, xml.error()};
    const std::string path = file_of(output, row, is_recommended);
    texts.emplace_back(path, *xml);
    written.files[row.name] = path;
  }
  std::error_code failed;
  if (!is_one_file(output) && !texts.empty()) fs::create_directories(output, failed);
  if (failed) return {{}, InputError{output, failed.message()}};
  for (const auto& [path, xml] : texts) {
    OutputFile file{path};
    auto error = file.open_error();
    if (!error) file.stream() << xml;
    if (!error) error = file.commit();
    if (error) return {{}, InputError{"-o", *error}};
  }
  return written;
}

std::optional<std::string> refuse_output(const std::string& output) {
  if (output.empty()) return std::nullopt;
  const fs::path folder = is_one_file(output) ? fs::path{output}.parent_path() : fs::path{output};
  std::error_code ignored;
  const auto status = fs::status(folder.empty() ? fs::path{"."} : folder, ignored);
  if (fs::is_directory(status) || (!is_one_file(output) && !fs::exists(status)))
    return std::nullopt;
  return fmt::format("-o {}: {} is no folder", output, folder.string());
}

}  // namespace stormproof::cli
