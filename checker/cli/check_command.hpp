// `stormproof check SCENARIO`: which properties of the catalogue hold for this deployment, profile
// and channel, and of what kind each answer is.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "checker/presentation/document/format.hpp"

namespace stormproof::cli {

struct CheckArguments {
  std::string scenario;                 ///< file, or name of a shipped scenario
  std::vector<std::string> overrides;   ///< key.path=value
  std::vector<std::string> properties;  ///< ids; empty: the whole catalogue
  report::Format format = report::Format::text;
  std::vector<std::string> reports;  ///< FORMAT=FILE
  std::string require;               ///< "proved", "bounded", "sampled", or empty
  double timeout_seconds = 10;       ///< of each query, for each solver
  std::string export_directory;      ///< for SMT-LIB 2 files; empty: none
  std::string output_directory = "counterexamples";
  std::string emit_test;  ///< GoogleTest file; empty: none
  unsigned seed = 0;
  std::uint32_t samples = 12;
  bool single_solver = false;
  bool verbose = false;
  std::optional<bool> progress;  ///< not given: when stderr is a terminal
};

/// Exit code: violated if a property is; with `require`, inconclusive if a verdict is weaker than
/// that; without, inconclusive if one is inconclusive; otherwise established.
[[nodiscard]] int check(const CheckArguments& arguments);

}  // namespace stormproof::cli
