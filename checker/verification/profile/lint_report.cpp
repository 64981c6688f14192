// Collects remarks and writes them, as text and as JSON.
#include "checker/verification/profile/lint_report.hpp"

#include <algorithm>
#include <fstream>
#include <tuple>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "checker/presentation/text/paragraph.hpp"
#include "checker/presentation/text/source_line.hpp"

namespace stormproof::report {

namespace config = model::config;
namespace vendor = model::config::vendor;
using Json = nlohmann::ordered_json;
using vendor::Remark;
using vendor::Severity;

namespace {

constexpr const char* unmodelled_rule = "unmodelled";

std::string source_of(const config::Place& place) { return place.source ? *place.source : ""; }

auto order(const Remark& remark) {
  return std::tuple{source_of(remark.place), remark.place.line, remark.place.column};
}

/// Whether the vendor's file sets it to what the model does, in place of a base's other value.
bool is_as_in_the_model(const config::TracedProfile& traced, const std::string& path) {
  if (!traced.vendor) return false;
  const auto& settings = traced.vendor->settings;
  const auto of_path = [&](const vendor::Setting& one) { return one.path == path; };
  const auto last = std::find_if(settings.rbegin(), settings.rend(), of_path);
  return last != settings.rend() && last->effect == vendor::Effect::none;
}

/// A note for each setting of the linted file that the model has not got, unless there is a remark
/// at its place.
void add_unmodelled(const config::TracedProfile& traced, const config::SpecPath& specs,
                    LintedFile& linted) {
  for (const auto& [setting, effect] : traced.profile.unmodelled) {
    const auto place = traced.places.find("unmodelled." + setting);
    if (place == traced.places.end()) continue;
    const std::string file = source_of(place->second);
    const auto preset = specs.name_of(config::SpecKind::dds, file);
    if (preset && *preset != linted.reference && file != linted.reference) {
      ++linted.unmodelled_below;
      continue;
    }
    if (is_as_in_the_model(traced, setting)) continue;
    const auto is_about = [&](const Remark& remark) {
      return source_of(remark.place) == file && remark.place.line == place->second.line &&
             remark.place.column == place->second.column && remark.rule != unmodelled_rule;
    };
    if (std::ranges::any_of(linted.remarks, is_about)) continue;
    linted.remarks.push_back({Severity::note, unmodelled_rule, place->second,
                              fmt::format("{} is not in the model: {}", setting, effect), ""});
  }
}

std::string plural(std::size_t count, const char* word) {
  return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
}

/// `text` in lines of the report's width. The first is as a compiler's warning begins; the others
/// are indented, so that a program that looks for places finds each remark once.
std::string folded(std::string_view text) {
  constexpr std::string_view indent = "    ";
  std::string out;
  std::size_t used = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const bool breaks = used > indent.size() && used + 1 + columns(word) > report_width;
    if (breaks) {
      out += '\n';
      out += indent;
      used = indent.size();
    } else if (!out.empty()) {
      out += ' ';
      ++used;
    }
    out += word;
    used += columns(word);
  }
  return out + "\n";
}

std::string remark_text(const Remark& remark, SourceLines& sources) {
  std::string text =
      folded(fmt::format("{}: {}: {} [{}]", remark.place.to_string(),
                         vendor::name_of(remark.severity), remark.message, remark.rule));
  text += sources.marked(remark.place);
  if (!remark.hint.empty()) text += paragraph("  hint: ", remark.hint);
  return text;
}

Json remark_json(const Remark& remark) {
  return {{"severity", vendor::name_of(remark.severity)},
          {"rule", remark.rule},
          {"file", source_of(remark.place)},
          {"line", remark.place.line},
          {"column", remark.place.column},
          {"message", remark.message},
          {"hint", remark.hint.empty() ? Json() : Json(remark.hint)}};
}

}  // namespace

LintedFile lint_profile(const std::string& reference, const config::SpecPath& specs) {
  LintedFile linted;
  linted.reference = reference;
  const auto traced = config::trace_dds_profile(reference, {}, specs, config::Outside::admitted);
  if (!traced) {
    linted.error = traced.error();
    return linted;
  }
  linted.preset = traced->preset;
  if (traced->vendor) linted.remarks = traced->vendor->remarks;
  add_unmodelled(*traced, specs, linted);
  std::ranges::stable_sort(linted.remarks, {}, order);
  return linted;
}

LintCounts count(const std::vector<LintedFile>& files) {
  LintCounts counts;
  for (const LintedFile& file : files) {
    if (file.error) ++counts.unreadable;
    for (const Remark& remark : file.remarks) {
      ++(remark.severity == Severity::error     ? counts.errors
         : remark.severity == Severity::warning ? counts.warnings
                                                : counts.notes);
    }
  }
  return counts;
}

std::string to_text(const std::vector<LintedFile>& files) {
  std::string text;
  SourceLines sources;
  for (const LintedFile& file : files) {
    if (file.error) {
      text += folded(fmt::format("{}: error: {}", file.error->where, file.error->message));
    }
    for (const Remark& remark : file.remarks) text += remark_text(remark, sources);
    if (file.unmodelled_below == 0) continue;
    text += folded(fmt::format(
        "{}: its base, {}, names {} that the model has not got; profile show lists them",
        file.reference, file.preset, plural(file.unmodelled_below, "setting")));
  }
  const LintCounts counts = count(files);
  text +=
      fmt::format("{}: {}, {}, {}", plural(files.size(), "file"), plural(counts.errors, "error"),
                  plural(counts.warnings, "warning"), plural(counts.notes, "note"));
  if (counts.unreadable > 0) text += fmt::format(", {} unreadable", counts.unreadable);
  return text + "\n";
}

Json to_json(const std::vector<LintedFile>& files) {
  Json json;
  json["files"] = Json::array();
  for (const LintedFile& file : files) {
    Json entry{{"file", file.reference}, {"error", nullptr}};
    if (file.error) {
      entry["error"] = {{"where", file.error->where}, {"message", file.error->message}};
    }
    entry["preset"] = file.preset.empty() ? Json() : Json(file.preset);
    entry["remarks"] = Json::array();
    for (const Remark& remark : file.remarks) entry["remarks"].push_back(remark_json(remark));
    entry["unmodelled_below"] = file.unmodelled_below;
    json["files"].push_back(std::move(entry));
  }
  const LintCounts counts = count(files);
  json["summary"] = {{"errors", counts.errors},
                     {"warnings", counts.warnings},
                     {"notes", counts.notes},
                     {"unreadable", counts.unreadable}};
  return json;
}

}  // namespace stormproof::report
