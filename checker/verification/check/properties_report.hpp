// The answer of `stormproof properties`: the catalogue.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"

namespace stormproof::checker {

/// Each property with its statement, in words and formally, what it assumes and who decides it.
[[nodiscard]] report::Document properties_document();

/// Keys: properties (id, statement, formal, fastdds, assumptions, engines, reference).
[[nodiscard]] nlohmann::ordered_json properties_json();
[[nodiscard]] nlohmann::ordered_json properties_schema(report::SchemaDefinitions& definitions);

}  // namespace stormproof::checker
