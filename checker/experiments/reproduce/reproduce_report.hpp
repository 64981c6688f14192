// The report of a reproduction, as a document, JSON and CSV.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "checker/experiments/reproduce/figures.hpp"
#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"

namespace stormproof::reproduce {

struct Report {
  std::string version;  ///< of this program
  Published published;
  Results results;
  std::vector<Figure> figures;
};

/// Tables, and on pages plots in the shape of the paper's figures.
[[nodiscard]] report::Document document_of(const Report& report);

/// Everything, exact times in nanoseconds included. A value that does not exist is null.
[[nodiscard]] nlohmann::ordered_json to_json(const Report& report);
[[nodiscard]] nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions);

/// One line for each published figure and variant.
[[nodiscard]] std::string figures_csv(const Report& report);
/// One line for each configuration, variant, network, HEARTBEAT policy and order of service.
[[nodiscard]] std::string configurations_csv(const Report& report);

/// "120", "1,850", "0.07", "3.13": four significant digits, all digits of numbers below 100,000
/// that are whole; "–" without a value.
[[nodiscard]] std::string number_text(std::optional<double> value);
/// Numbers that belong together: "15.7 … 18.4"; of long lists the ends.
[[nodiscard]] std::string numbers_text(const std::vector<double>& values);
/// The same with all digits that are published.
[[nodiscard]] std::string published_text(const std::vector<double>& values);
/// "0.97 ×".
[[nodiscard]] std::string ratio_text(std::optional<double> ratio);
/// "+25.3 pt", how far two percentages are apart: a ratio of percentages says nothing.
[[nodiscard]] std::string distance_text(double points);

}  // namespace stormproof::reproduce
