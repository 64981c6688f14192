// SARIF 2.1.0, the form in which code scanning takes findings: each result says which rule, how
// bad, and at which line and column of the user's file. A result with the level `none` is of kind
// `pass`; one at the level `warning` that nobody could decide stays a warning, as code scanning
// shows it.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "checker/presentation/document/render.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "model/config/shown_path.hpp"
#include "model/trace/scenario_names.hpp"

namespace stormproof::report {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

const char* level_of(const Finding& finding) {
  switch (finding.outcome) {
    case Finding::Outcome::passed:
      return "none";
    case Finding::Outcome::note:
      return "note";
    case Finding::Outcome::unknown:
      return "warning";
    case Finding::Outcome::disputed:
      return "error";
    case Finding::Outcome::failed:
      break;
  }
  return finding.warning ? "warning" : "error";
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
int character_column(const Location& at) {
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

Json physical_location(const Location& at) {
  Json location;
  location["artifactLocation"] = {{"uri", uri_of(at.file)}};
  // Code scanning wants a region even where the whole file is meant.
  Json region;
  region["startLine"] = std::max(at.line, 1);
  if (at.line > 0 && at.column > 0) region["startColumn"] = character_column(at);
  location["region"] = region;
  return location;
}

Json location_json(const Location& at) {
  Json location;
  location["physicalLocation"] = physical_location(at);
  if (!at.message.empty()) location["message"] = message(at.message);
  return location;
}

Json rule_json(const Finding& finding) {
  Json json;
  json["id"] = finding.id;
  json["shortDescription"] = message(finding.statement);
  json["fullDescription"] =
      message(finding.description.empty() ? finding.statement : finding.description);
  json["defaultConfiguration"] = {{"level", "error"}};
  return json;
}

std::string sentences_of(const Finding& finding) {
  std::string text = finding.word.empty() ? finding.message : finding.word + ": " + finding.message;
  if (!finding.command.empty()) text += " Repeat it: " + finding.command;
  return text;
}

Json result_json(const Finding& finding, std::size_t rule) {
  Json json;
  json["ruleId"] = finding.id;
  json["ruleIndex"] = rule;
  json["kind"] = finding.outcome == Finding::Outcome::passed ? "pass" : "fail";
  json["level"] = level_of(finding);
  json["message"] = message(sentences_of(finding));
  json["locations"] = Json::array();
  std::vector<std::string> identity{finding.id};
  for (const Location& at : finding.locations) {
    if (at.file.empty()) continue;
    json["locations"].push_back(location_json(at));
    identity.push_back(uri_of(at.file));
  }
  for (const Location& at : finding.related) {
    if (at.file.empty()) continue;
    Json related = location_json(at);
    related["id"] = json.contains("relatedLocations") ? json["relatedLocations"].size() : 0;
    json["relatedLocations"].push_back(std::move(related));
  }
  identity.insert(identity.end(), finding.identity.begin(), finding.identity.end());
  json["partialFingerprints"] = {{"stormproofFinding/v1", fingerprint(identity)}};
  return json;
}

Json driver_json(Json rules) {
  Json driver;
  driver["name"] = "stormproof";
  const std::string program = model::trace::program_name();  // "stormproof 1.2.3"
  driver["version"] = program.substr(program.find(' ') + 1);
  driver["semanticVersion"] = driver["version"];
  driver["rules"] = std::move(rules);
  return driver;
}

}  // namespace

std::string uri_of(const std::string& path) {
  std::error_code failed;
  fs::path shown = fs::path{model::config::shown_path(path)}.lexically_normal();
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

Json to_sarif(const Document& document) {
  Json rules = Json::array();
  Json results = Json::array();
  for (const Finding& finding : document.findings) {
    if (finding.shown == Finding::Shown::tests) continue;
    const auto is_same = [&](const Json& rule) { return rule["id"] == finding.id; };
    const auto known = std::ranges::find_if(rules, is_same);
    const auto rule = static_cast<std::size_t>(known - rules.begin());
    if (known == rules.end()) rules.push_back(rule_json(finding));
    results.push_back(result_json(finding, rule));
  }
  Json invocation;
  if (!document.command.empty()) invocation["commandLine"] = valid_text(document.command);
  invocation["executionSuccessful"] = document.complete;
  invocation["exitCode"] = document.exit_code;
  Json run;
  run["tool"] = {{"driver", driver_json(std::move(rules))}};
  run["invocations"] = Json::array({invocation});
  run["columnKind"] = "unicodeCodePoints";
  run["results"] = std::move(results);
  Json json;
  json["$schema"] = "https://json.schemastore.org/sarif-2.1.0.json";
  json["version"] = "2.1.0";
  json["runs"] = Json::array({run});
  return json;
}

}  // namespace stormproof::report
