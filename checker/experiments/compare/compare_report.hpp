// The answer of `stormproof compare-discovery`: a document, JSON, and charts.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "checker/experiments/compare/compare.hpp"
#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"

namespace stormproof::compare {

[[nodiscard]] report::Document document_of(const Report& report, const Request& request);
/// specs/guide/comparing-discovery.md describes the keys.
[[nodiscard]] nlohmann::ordered_json to_json(const Report& report, const Request& request);
[[nodiscard]] nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions);

/// The figure of every candidate over the size: medians, and the ranges of the runs.
[[nodiscard]] std::string growth_plot(const Report& report, Figure figure);
/// Messages by class at the scenario's own size.
[[nodiscard]] std::string classes_plot(const Report& report);

}  // namespace stormproof::compare
