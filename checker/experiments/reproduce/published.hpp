// The published figures and what is known about them: specs/published/paper-tables.yaml and
// paper-notes.yaml, read into a flat list, so that no figure can be left out unnoticed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/config/spec_path.hpp"
#include "model/config/tree/result.hpp"

namespace stormproof::reproduce {

/// What stands beside a published figure.
enum class Kind : std::uint8_t {
  input,       ///< it describes the experiments; the reproduction takes it over
  model,       ///< the model's value of the same quantity
  nearest,     ///< the nearest quantity that can be had from what is printed
  unavailable  ///< nothing: it takes the single runs of the laboratory
};
[[nodiscard]] const char* name_of(Kind kind);

/// One printed figure: a number, or numbers that belong together (quartiles, a list of sizes).
struct PublishedFigure {
  std::string id;  ///< path in the file, list items by their np or scope: "upper_range.np4.runs"
  std::vector<double> values;
  std::string unit;  ///< "s", "%" or empty
};

/// What the notes say about all figures that a pattern matches.
struct Note {
  std::vector<std::string> patterns;  ///< paths, `*` for any one part
  Kind kind{};
  std::string quantity;  ///< what the model's value is; empty for inputs
};

/// Why the model's value differs.
struct Reason {
  std::vector<std::string> patterns;
  std::vector<std::string> variants;  ///< ids of plan.hpp for which it holds; empty: all
  std::string text;
};

struct Published {
  std::vector<PublishedFigure> figures;  ///< in the order of the file
  std::vector<Note> notes;
  std::vector<Reason> reasons;

  [[nodiscard]] const PublishedFigure* find(const std::string& id) const;
  /// The values of a figure that must exist; read_published has made sure of those that the
  /// reproduction needs.
  [[nodiscard]] const std::vector<double>& values(const std::string& id) const;
  /// The one note of a figure.
  [[nodiscard]] const Note& note_of(const std::string& id) const;
  /// Positions of the reasons that apply to a figure and a variant; those that hold for all, if it
  /// is empty.
  [[nodiscard]] std::vector<std::size_t> reasons_of(const std::string& id,
                                                    const std::string& variant) const;
  /// … and to a figure, whatever the variant.
  [[nodiscard]] std::vector<std::size_t> reasons_of(const std::string& id) const;
};

/// Whether a path matches a pattern, part by part.
[[nodiscard]] bool matches(const std::string& pattern, const std::string& id);

/// Reads `published/paper-tables.yaml` and `published/paper-notes.yaml` from the first folder that
/// has them. An error if a figure has no note or two, if a note or reason matches no figure or
/// names an unknown variant, or if the grid is missing.
[[nodiscard]] model::config::Result<Published> read_published(const model::config::SpecPath& specs);

/// The same for texts in memory; `source` names them in errors.
[[nodiscard]] model::config::Result<Published> parse_published(const std::string& tables,
                                                               const std::string& notes,
                                                               const std::string& source);

}  // namespace stormproof::reproduce
