// All texts are made, and read back, before the first file is written.
#include "checker/cli/tune_files.hpp"

#include <fmt/core.h>

#include "checker/experiments/launch/launch_report.hpp"
#include "checker/experiments/tune/deploy.hpp"

namespace stormproof::cli {

namespace {

using model::config::SpecPath;

/// What stands at the top of a written file.
std::string comment_of(const std::string& origin, const tune::Subject& subject,
                       const tune::Row& row, const std::vector<std::string>& prerequisites) {
  std::string text = fmt::format("Settings for {}, chosen by {}.", subject.preset, origin);
  if (row.summary.completion_ns.median) {
    text += fmt::format(" Predicted: completion {:.3f} s, {:.0f} messages (medians).",
                        *row.summary.completion_ns.median / 1e9,
                        row.summary.messages.median.value_or(0));
  }
  for (const std::string& what : prerequisites) text += " " + what;
  return text;
}

/// "recommended.xml", "front-2.xml".
std::string file_name(const tune::Row& row, bool is_recommended) {
  if (is_recommended) return "recommended.xml";
  std::string name = row.name;
  if (const std::size_t space = name.find(' '); space != std::string::npos) name[space] = '-';
  return name + ".xml";
}

struct Text {
  std::string row, name, xml;
};

}  // namespace

TuneOutput::TuneOutput(const std::string& path) {
  if (path.ends_with(".xml")) {
    file_.open(path, "--output " + path);
  } else if (!path.empty()) {
    folder_.emplace("--output", path, "tune", std::vector<std::string>{});
  }
}

std::optional<std::string> TuneOutput::prepare() {
  return folder_ ? folder_->prepare() : file_.open_error();
}

std::optional<std::string> TuneOutput::write(const std::string& name, const std::string& xml) {
  if (folder_) return folder_->write(name, xml);
  file_.stream() << xml;
  error_ = file_.commit();
  return error_ ? std::nullopt : std::optional{file_.path()};
}

std::optional<std::string> TuneOutput::error() const { return folder_ ? folder_->error() : error_; }

TuneFiles write_files(TuneOutput& output, const std::string& origin, const std::string& named,
                      const tune::Subject& subject, const tune::Report& report) {
  TuneFiles written;
  const bool better = report.answer == tune::Answer::better;
  if (!output.wanted() || report.answer == tune::Answer::interrupted) return written;
  std::vector<Text> texts;
  for (std::size_t k = 0; k < report.rows.size(); ++k) {
    const tune::Row& row = report.rows[k];
    const bool is_recommended = better && report.recommended == k;
    if (row.kind != tune::Row::Kind::front || (output.is_one_file() && !is_recommended)) continue;
    const model::DdsProfile& profile = row.scenario.dds;
    const auto needs = tune::prerequisites(subject, profile);
    const auto xml = tune::deployable(subject, profile, comment_of(origin, subject, row, needs),
                                      SpecPath::standard());
    if (!xml) return {{}, {}, to_string(xml.error())};
    texts.push_back({row.name, file_name(row, is_recommended), *xml});
  }
  for (const auto& [row, name, xml] : texts) {
    if (const auto path = output.write(name, xml)) written.files[row] = *path;
  }
  if (const tune::Row* best = better ? &report.rows[*report.recommended] : nullptr;
      best != nullptr && best->plan && !output.is_one_file()) {
    for (const launch::LaunchFile& file : launch::launch_files(
             "with recommended.xml", best->scenario, *best->plan, named, report.compared.first)) {
      if (const auto path = output.write(file.name, file.text)) written.launch.push_back(*path);
    }
  }
  written.error = output.error();
  return written;
}

}  // namespace stormproof::cli
