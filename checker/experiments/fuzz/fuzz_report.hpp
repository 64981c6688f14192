// What `stormproof fuzz` prints.
#pragma once

#include <map>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "checker/experiments/fuzz/fuzz.hpp"
#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"

namespace stormproof::fuzz {

/// Around the report: names, commands and files.
struct FuzzContext {
  std::string name;  ///< what the user called the scenario
  const model::Scenario& scenario;
  std::string command;  ///< `stormproof fuzz …` with everything but --runs, --seed and --first
  std::map<std::string_view, std::string> stems;     ///< by id: files STEM.yaml, STEM.txt, …
  std::map<std::string_view, std::string> traces{};  ///< by id: those that could be written

  /// The command that repeats the whole report, or one run of it.
  [[nodiscard]] std::string whole(const FuzzReport& report) const;
  [[nodiscard]] std::string single(const FuzzReport& report, std::uint64_t number) const;
};

[[nodiscard]] report::Document document_of(const FuzzReport& report, const FuzzContext& context);

/// specs/guide/output.md describes the keys.
[[nodiscard]] nlohmann::ordered_json to_json(const FuzzReport& report, const FuzzContext& context);
[[nodiscard]] nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions);

}  // namespace stormproof::fuzz
