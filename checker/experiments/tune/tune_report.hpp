// The report of a tuning as a document, as JSON, and as a plot of completion against messages.
#pragma once

#include <map>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "checker/experiments/tune/tune.hpp"
#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"

namespace stormproof::tune {

/// What surrounds a report.
struct Context {
  std::string scenario;  ///< as it was named
  std::vector<std::string> overrides{};
  const Subject& subject;
  const Options& options;
  std::map<std::string, std::string, std::less<>> files{};  ///< name of a row → its written XML
  std::vector<std::string> prerequisites{};                 ///< of the recommended setting
  std::vector<std::string> loading{};                       ///< lines of a shell that load its file
  std::string repeat{};  ///< command that measures the recommended file again; empty: none
  std::vector<std::string>
      check{};                  ///< lines of the check of the recommended setting; may be empty
  bool files_wanted = false;    ///< if there are none, the report says so
  bool newly_violated = false;  ///< by that check
};

[[nodiscard]] report::Document document_of(const Report& report, const Context& context);
/// specs/guide/output.md describes the keys.
[[nodiscard]] nlohmann::ordered_json to_json(const Report& report, const Context& context);
[[nodiscard]] nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions);
[[nodiscard]] std::string to_svg(const Report& report, const Context& context);

/// The setting in one line: "sendBufferSize 4000000, maxMessageSize 1400".
[[nodiscard]] std::string settings_text(const Row& row);

}  // namespace stormproof::tune
