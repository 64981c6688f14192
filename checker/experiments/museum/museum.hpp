// The museum of defects: every exhibit is run, and what is found is held against what it expects.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "checker/experiments/museum/search.hpp"
#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"

namespace stormproof::museum {

struct ShownExhibit {
  Exhibit exhibit;
  Found before;
  Found after;
  std::vector<Found> decoys;

  /// Whether everything is as the exhibit says.
  [[nodiscard]] bool as_expected() const;
};

struct Report {
  std::vector<ShownExhibit> exhibits;
  bool finished = true;

  [[nodiscard]] bool as_expected() const;
};

/// `go_on` is asked before each run.
[[nodiscard]] Report show(std::vector<Exhibit> exhibits, const std::function<bool()>& go_on);

/// A list of several, the story of a single one. `reference` is what the user asked for, or empty.
[[nodiscard]] report::Document document_of(const Report& report, const std::string& reference);
[[nodiscard]] nlohmann::ordered_json to_json(const Report& report);
[[nodiscard]] nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions);

}  // namespace stormproof::museum
