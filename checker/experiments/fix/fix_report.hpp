// The answer of `stormproof fix`: a document, and JSON.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "checker/experiments/fix/fix.hpp"
#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"

namespace stormproof::fix {

/// What surrounds a report.
struct Context {
  std::vector<std::string> written = {};  ///< paths of the files to deploy
  std::vector<std::string> loading = {};  ///< lines of a shell that make use of them
};

[[nodiscard]] report::Document document_of(const Report& report, const Request& request,
                                           const Context& context);
/// specs/guide/fix.md describes the keys.
[[nodiscard]] nlohmann::ordered_json to_json(const Report& report, const Request& request,
                                             const Context& context);
[[nodiscard]] nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions);

}  // namespace stormproof::fix
