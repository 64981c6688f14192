// Remarks as compilers write them, one listing for all: editors and people read the places. Each is
// a finding, too, so that a review shows it beside the line.
#include <fmt/core.h>

#include "checker/presentation/text/paragraph.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "checker/presentation/text/source_line.hpp"
#include "checker/verification/profile/lint_report.hpp"

namespace stormproof::report {

namespace vendor = model::config::vendor;

namespace {

/// `text` in lines of the report's width. The first is as a compiler's warning begins; the others
/// are indented, so that a program that looks for places finds each remark once.
std::string folded(std::string_view text) {
  std::string out;
  for (const std::string& line : wrapped(text, report_width, 4)) out += line + "\n";
  return out;
}

std::string remark_text(const vendor::Remark& remark, SourceLines& sources) {
  std::string text =
      folded(fmt::format("{}: {}: {} [{}]", remark.place.to_string(),
                         vendor::name_of(remark.severity), remark.message, remark.rule));
  text += sources.marked(remark.place);
  if (!remark.hint.empty()) text += paragraph("  hint: ", remark.hint);
  return text;
}

Finding finding_of(const vendor::Remark& remark) {
  Finding finding;
  finding.id = "lint." + remark.rule;
  finding.group = "stormproof.lint";
  finding.name = remark.place.to_string() + " " + remark.rule;
  finding.statement = "profile lint: " + remark.rule;
  finding.outcome =
      remark.severity == vendor::Severity::note ? Finding::Outcome::note : Finding::Outcome::failed;
  finding.warning = remark.severity == vendor::Severity::warning;
  finding.word = vendor::name_of(remark.severity);
  finding.message = remark.message;
  if (!remark.hint.empty()) finding.details = "hint: " + remark.hint + "\n";
  finding.locations.emplace_back(remark.place);
  finding.identity = {remark.message};
  return finding;
}

Finding unreadable(const LintedFile& file) {
  Finding finding;
  finding.id = "lint.unreadable";
  finding.group = "stormproof.lint";
  finding.name = file.reference;
  finding.statement = "profile lint: the file is no profile";
  finding.outcome = Finding::Outcome::failed;
  finding.word = "error";
  finding.message = to_string(*file.error);
  finding.locations.emplace_back().file = file.reference;
  return finding;
}

Finding readable(const LintedFile& file) {
  Finding finding;
  finding.id = "lint.readable";
  finding.group = "stormproof.lint";
  finding.name = file.reference;
  finding.shown = Finding::Shown::tests;
  return finding;
}

}  // namespace

Document document_of(const std::vector<LintedFile>& files) {
  Document document;
  document.title = "stormproof profile lint";
  std::string text;
  SourceLines sources;
  for (const LintedFile& file : files) {
    document.title += " " + file.reference;
    document.findings.push_back(file.error ? unreadable(file) : readable(file));
    if (file.error) {
      text += folded(fmt::format("{}: error: {}", file.error->where, file.error->message));
    }
    for (const vendor::Remark& remark : file.remarks) {
      text += remark_text(remark, sources);
      document.findings.push_back(finding_of(remark));
    }
    if (file.unmodelled_below == 0) continue;
    text += folded(fmt::format(
        "{}: its base, {}, names {} that the model has not got; profile show lists them",
        file.reference, file.preset, plural(file.unmodelled_below, "setting")));
  }
  const LintCounts counts = count(files);
  std::string answer =
      fmt::format("{}: {}, {}, {}", plural(files.size(), "file"), plural(counts.errors, "error"),
                  plural(counts.warnings, "warning"), plural(counts.notes, "note"));
  if (counts.unreadable > 0) answer += fmt::format(", {} unreadable", counts.unreadable);
  document.answer = std::move(answer);
  document.tone = counts.errors + counts.unreadable > 0 ? Tone::bad
                  : counts.warnings > 0                 ? Tone::warn
                                                        : Tone::good;
  if (!text.empty()) document.blocks.emplace_back(Listing{std::move(text)});
  return document;
}

}  // namespace stormproof::report
