// The answer of `stormproof coverage`: a document, JSON, and charts.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "checker/evidence/coverage/study.hpp"
#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"

namespace stormproof::prediction {

/// What was asked, for the head of a report.
struct Heading {
  std::string observations;  ///< file
  std::size_t rows = 0;
  std::size_t not_selected = 0;
  std::string wireless;
  std::size_t samples = 0;
  std::uint64_t first_seed = 0;
};

/// Without exit code, which only the caller knows.
[[nodiscard]] report::Document document_of(const Heading& heading, const Study& study);

/// specs/guide/coverage.md describes the keys.
[[nodiscard]] nlohmann::ordered_json to_json(const Heading& heading, const Study& study);
[[nodiscard]] nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions);

struct ChartFile {
  std::string name;  ///< of the file, without folder
  std::string svg;
};
/// Model against measurement for completion and all messages, and calibration.
[[nodiscard]] std::vector<ChartFile> charts(const ProfileStudy& profile);

}  // namespace stormproof::prediction
