// The answer of `stormproof profile lint`: remarks about profile files in the form that compilers
// have made familiar, with the line that each is about.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"
#include "model/config/scenario_file.hpp"

namespace stormproof::report {

struct LintedFile {
  std::string reference;                               ///< as the user gave it
  std::optional<model::config::InputError> error;      ///< it cannot be read; then there is no more
  std::string preset;                                  ///< that it builds on; empty: none
  std::vector<model::config::vendor::Remark> remarks;  ///< by place
  std::size_t unmodelled_below = 0;  ///< settings that the model has not got, of its bases
};

/// What a reference stands for when nothing of it was chosen: one reference for each domain of a
/// Cyclone DDS file with settings for several, otherwise the reference itself.
[[nodiscard]] std::vector<std::string> parts_of(const std::string& reference,
                                                const model::config::SpecPath& specs);

/// Reads a profile and takes its remarks: of a vendor's file those that its reader makes, and a
/// note for each setting that the model has not got.
[[nodiscard]] LintedFile lint_profile(const std::string& reference,
                                      const model::config::SpecPath& specs);

struct LintCounts {
  std::size_t unreadable = 0, errors = 0, warnings = 0, notes = 0;
};
[[nodiscard]] LintCounts count(const std::vector<LintedFile>& files);

/// A summary; then "FILE:LINE:COLUMN: warning: MESSAGE [RULE]", hint, line and caret for each.
/// Reads the files again for their lines.
[[nodiscard]] Document document_of(const std::vector<LintedFile>& files);

/// specs/guide/output.md describes the keys.
[[nodiscard]] nlohmann::ordered_json to_json(const std::vector<LintedFile>& files);
[[nodiscard]] nlohmann::ordered_json lint_schema(SchemaDefinitions& definitions);

}  // namespace stormproof::report
