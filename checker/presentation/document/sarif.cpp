// Writes the log. A result with the level `none` is of kind `pass`; one at the level `warning` that
// nobody could decide stays a warning, as code scanning shows it.
#include "checker/presentation/document/sarif.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "checker/presentation/text/plain_text.hpp"
#include "model/trace/scenario_names.hpp"

namespace stormproof::report {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Level = SarifResult::Level;

const char* name_of(Level level) {
  switch (level) {
    case Level::none:
      return "none";
    case Level::note:
      return "note";
    case Level::warning:
      return "warning";
    case Level::error:
      return "error";
  }
  return "none";
}

Json message(const std::string& text) { return Json{{"text", valid_text(text)}}; }

/// FNV-1a: the same on every machine, unlike std::hash.
std::string fingerprint(const std::vector<std::string>& parts) {
  std::uint64_t hash = 14'695'981'039'346'656'037U;
  for (const std::string& part : parts) {
    for (const char c : part + '\n') {
      hash = (hash ^ static_cast<unsigned char>(c)) * 1'099'511'628'211U;
    }
  }
  return fmt::format("{:016x}", hash);
}

/// The column in characters; in bytes if the line cannot be read.
int character_column(const SarifLocation& at) {
  std::ifstream file{at.file, std::ios::binary};
  std::string line;
  for (int k = 0; k < at.line; ++k) {
    if (!std::getline(file, line)) return at.column;
  }
  int column = 1;
  const auto before = std::min(static_cast<std::size_t>(at.column - 1), line.size());
  for (std::size_t k = 0; k < before; ++k) {
    if ((static_cast<unsigned char>(line[k]) & 0xc0U) != 0x80U) ++column;
  }
  return column + (at.column - 1 - static_cast<int>(before));
}

Json physical_location(const SarifLocation& at) {
  Json location;
  location["artifactLocation"] = {{"uri", uri_of(at.file)}};
  // Code scanning wants a region even where the whole file is meant.
  Json region;
  region["startLine"] = std::max(at.line, 1);
  if (at.line > 0 && at.column > 0) region["startColumn"] = character_column(at);
  location["region"] = region;
  return location;
}

Json location_json(const SarifLocation& at) {
  Json location;
  location["physicalLocation"] = physical_location(at);
  if (!at.message.empty()) location["message"] = message(at.message);
  return location;
}

Json rule_json(const SarifRule& rule) {
  Json json;
  json["id"] = rule.id;
  json["shortDescription"] = message(rule.name);
  json["fullDescription"] = message(rule.description.empty() ? rule.name : rule.description);
  json["defaultConfiguration"] = {{"level", "error"}};
  return json;
}

Json result_json(const SarifResult& result, const SarifLog& log) {
  Json json;
  json["ruleId"] = result.rule;
  const auto rule = std::ranges::find(log.rules, result.rule, &SarifRule::id);
  if (rule != log.rules.end()) json["ruleIndex"] = rule - log.rules.begin();
  json["kind"] = result.level == Level::none ? "pass" : "fail";
  json["level"] = name_of(result.level);
  json["message"] = message(result.message);
  json["locations"] = Json::array();
  std::vector<std::string> identity{result.rule};
  for (const SarifLocation& at : result.locations) {
    if (at.file.empty()) continue;
    json["locations"].push_back(location_json(at));
    identity.push_back(uri_of(at.file));
  }
  for (const SarifLocation& at : result.related) {
    if (at.file.empty()) continue;
    Json related = location_json(at);
    related["id"] = json.contains("relatedLocations") ? json["relatedLocations"].size() : 0;
    json["relatedLocations"].push_back(std::move(related));
  }
  identity.insert(identity.end(), result.identity.begin(), result.identity.end());
  json["partialFingerprints"] = {{"stormproofFinding/v1", fingerprint(identity)}};
  return json;
}

Json driver_json(const SarifLog& log) {
  Json driver;
  driver["name"] = "stormproof";
  const std::string program = model::trace::program_name();  // "stormproof 1.2.3"
  driver["version"] = program.substr(program.find(' ') + 1);
  driver["semanticVersion"] = driver["version"];
  driver["rules"] = Json::array();
  for (const SarifRule& rule : log.rules) driver["rules"].push_back(rule_json(rule));
  return driver;
}

}  // namespace

SarifLocation::SarifLocation(const model::config::Place& place, std::string text)
    : line{place.line}, column{place.column}, message{std::move(text)} {
  if (place.source != nullptr && place.line > 0) file = *place.source;
}

std::string uri_of(const std::string& path) {
  std::error_code failed;
  fs::path shown = fs::path{path}.lexically_normal();
  if (shown.is_absolute()) {
    const fs::path here = fs::current_path(failed);
    const fs::path inside = failed ? fs::path{} : shown.lexically_relative(here);
    if (!inside.empty() && *inside.begin() != "..") shown = inside;
  }
  std::string uri = shown.is_absolute() ? "file://" : "";
  for (const char c : shown.generic_string()) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') ||
                       (byte >= '0' && byte <= '9') ||
                       std::string_view{"-._~/"}.find(c) != std::string_view::npos;
    uri += plain ? std::string{c} : fmt::format("%{:02X}", byte);
  }
  return uri;
}

Json to_json(const SarifLog& log) {
  Json run;
  run["tool"] = {{"driver", driver_json(log)}};
  Json invocation;
  if (!log.command.empty()) invocation["commandLine"] = valid_text(log.command);
  invocation["executionSuccessful"] = log.complete;
  invocation["exitCode"] = log.exit_code;
  run["invocations"] = Json::array({invocation});
  run["columnKind"] = "unicodeCodePoints";
  run["results"] = Json::array();
  for (const SarifResult& result : log.results) run["results"].push_back(result_json(result, log));
  Json json;
  json["$schema"] = "https://json.schemastore.org/sarif-2.1.0.json";
  json["version"] = "2.1.0";
  json["runs"] = Json::array({run});
  return json;
}

}  // namespace stormproof::report
