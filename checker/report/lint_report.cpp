// Collects remarks and writes them, as text and as JSON.
#include "checker/report/lint_report.hpp"

#include <algorithm>
#include <fstream>
#include <tuple>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "checker/report/source_line.hpp"

namespace stormproof::report {

namespace config = model::config;
namespace vendor = model::config::vendor;
using Json = nlohmann::ordered_json;
using vendor::Remark;
using vendor::Severity;

namespace {

std::string source_of(const config::Place& place) { return place.source ? *place.source : ""; }

auto order(const Remark& remark) {
  return std::tuple{source_of(remark.place), remark.place.line, remark.place.column};
}

/// A note for each setting of the linted file that the model has not got, unless there is a remark
/// about it.
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
    const auto is_about = [&](const Remark& remark) {
      return source_of(remark.place) == file && remark.place.line == place->second.line;
    };
    if (std::ranges::any_of(linted.remarks, is_about)) continue;
    linted.remarks.push_back({Severity::note, "unmodelled", place->second,
                              fmt::format("{} is not in the model: {}", setting, effect), ""});
  }
}

std::string plural(std::size_t count, const char* word) {
  return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
}

std::string remark_text(const Remark& remark) {
  std::string text = fmt::format("{}: {}: {} [{}]\n", remark.place.to_string(),
                                 vendor::name_of(remark.severity), remark.message, remark.rule);
  text += source_line(remark.place);
  if (!remark.hint.empty()) text += fmt::format("  hint: {}\n", remark.hint);
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
  for (const LintedFile& file : files) {
    if (file.error) text += fmt::format("{}: error: {}\n", file.error->where, file.error->message);
    for (const Remark& remark : file.remarks) text += remark_text(remark);
    if (file.unmodelled_below == 0) continue;
    text += fmt::format(
        "{}: its base, {}, names {} that the model has not got; profile show lists them\n",
        file.reference, file.preset, plural(file.unmodelled_below, "setting"));
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
