// Collects remarks.
#include "checker/verification/profile/lint_report.hpp"

#include <algorithm>
#include <tuple>

#include <fmt/core.h>

#include "model/config/vendor/reference.hpp"

namespace stormproof::report {

namespace config = model::config;
namespace vendor = model::config::vendor;
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
  for (const auto& [setting, effect] : traced.value.unmodelled) {
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

}  // namespace

std::vector<std::string> parts_of(const std::string& reference, const config::SpecPath& specs) {
  const auto parts = vendor::parse_reference(reference);
  if (!parts || parts->file.empty() || !parts->selection.profile.empty()) return {reference};
  const auto file = specs.find(config::SpecKind::dds, parts->file, "", reference);
  if (!file) return {reference};
  const auto document = vendor::load_xml(*file);
  if (!document) return {reference};
  std::vector<std::string> all = vendor::domains_of(*document);
  if (all.size() < 2) return {reference};
  const std::string& base = parts->selection.base;
  for (std::string& domain : all) {
    domain = parts->file + "#" + domain + (base.empty() ? "" : "@" + base);
  }
  return all;
}

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

}  // namespace stormproof::report
