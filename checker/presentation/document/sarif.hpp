// SARIF 2.1.0, the form in which code scanning takes findings: each result says which rule, how
// bad, and at which line and column of the user's file. One writer for all reports.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "checker/presentation/document/document.hpp"

namespace stormproof::report {

using SarifLocation = Location;

struct SarifRule {
  std::string id;
  std::string name;         ///< one sentence
  std::string description;  ///< more; may be empty
};

struct SarifResult {
  enum class Level : std::uint8_t { none, note, warning, error };
  std::string rule;
  Level level = Level::error;
  std::string message;
  std::vector<SarifLocation> locations;  ///< one, or none
  std::vector<SarifLocation> related;
  /// What makes it the same finding tomorrow, without numbers that change with every run.
  std::vector<std::string> identity;
};

struct SarifLog {
  std::vector<SarifRule> rules;  ///< those of all results
  std::vector<SarifResult> results;
  int exit_code = 0;
  std::string command;   ///< may be empty
  bool complete = true;  ///< false: interrupted
};

/// Columns become characters if the file can be read; paths below the current folder become
/// relative to it.
[[nodiscard]] nlohmann::ordered_json to_json(const SarifLog& log);

}  // namespace stormproof::report
