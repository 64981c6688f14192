// The walk over the YAML of the published figures, and the check that every one is spoken for.
#include "checker/experiments/reproduce/published.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string_view>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "checker/experiments/reproduce/plan.hpp"

namespace stormproof::reproduce {

namespace {

using model::config::InputError;
using model::config::Result;
using model::config::SpecPath;

/// A mistake in one of the files; never leaves this one.
struct Mistake {
  YAML::Mark mark;
  std::string message;
};

double number(const YAML::Node& node, const std::string& path) {
  double value = 0;
  if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value)) {
    throw Mistake{node.Mark(), path + ": expected a number"};
  }
  return value;
}

bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

std::string unit_of(const std::string& path) {
  if (contains(path, "completion_s")) return "s";
  return contains(path, "_pct") ? "%" : "";
}

/// The name of a list item: its participant count or its scope.
std::string item_name(const YAML::Node& item, const std::string& path) {
  if (item.IsMap() && item["np"]) return "np" + item["np"].as<std::string>();
  if (item.IsMap() && item["scope"]) return item["scope"].as<std::string>();
  throw Mistake{item.Mark(), path + ": expected list items with 'np' or 'scope'"};
}

void collect(const YAML::Node& node, const std::string& path, std::vector<PublishedFigure>& out) {
  if (node.IsMap()) {
    for (const auto& entry : node) {
      const std::string key = entry.first.as<std::string>();
      if (key == "np" || key == "scope") continue;  // names of the list items
      collect(entry.second, path.empty() ? key : path + "." + key, out);
    }
  } else if (node.IsSequence() && node.size() > 0 && node[0].IsMap()) {
    for (const YAML::Node& item : node) collect(item, path + "." + item_name(item, path), out);
  } else if (node.IsSequence()) {
    PublishedFigure figure{path, {}, unit_of(path)};
    for (const YAML::Node& item : node) figure.values.push_back(number(item, path));
    out.push_back(std::move(figure));
  } else {
    out.push_back({path, {number(node, path)}, unit_of(path)});
  }
}

std::string text_of(const YAML::Node& entry, const char* key) {
  const YAML::Node node = entry[key];
  if (!node || !node.IsScalar()) {
    throw Mistake{entry.Mark(), fmt::format("expected the key '{}'", key)};
  }
  std::string text = node.as<std::string>();
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

/// One text, or several.
std::vector<std::string> texts_of(const YAML::Node& entry, const char* key) {
  const YAML::Node node = entry[key];
  std::vector<std::string> texts;
  if (node && node.IsScalar()) texts.push_back(node.as<std::string>());
  if (node && node.IsSequence()) {
    for (const YAML::Node& one : node) texts.push_back(one.as<std::string>());
  }
  return texts;
}

std::vector<std::string> patterns_of(const YAML::Node& entry) {
  std::vector<std::string> patterns = texts_of(entry, "figures");
  if (patterns.empty()) throw Mistake{entry.Mark(), "expected 'figures', one or several paths"};
  return patterns;
}

Kind kind_of(const YAML::Node& entry) {
  const std::string word = text_of(entry, "kind");
  for (const Kind kind : {Kind::input, Kind::model, Kind::nearest, Kind::unavailable}) {
    if (word == name_of(kind)) return kind;
  }
  throw Mistake{entry.Mark(), "'" + word + "': expected kind input, model, nearest or unavailable"};
}

void read_notes(const YAML::Node& root, Published& published) {
  for (const YAML::Node& entry : root["beside"]) {
    const Kind kind = kind_of(entry);
    published.notes.push_back({patterns_of(entry), kind, text_of(entry, "quantity")});
  }
  for (const YAML::Node& entry : root["reasons"]) {
    Reason reason{patterns_of(entry), texts_of(entry, "variants"), text_of(entry, "because")};
    const std::vector<std::string> known = variant_ids();
    for (const std::string& id : reason.variants) {
      if (std::find(known.begin(), known.end(), id) == known.end()) {
        throw Mistake{entry.Mark(), "'" + id + "' is not a variant"};
      }
    }
    published.reasons.push_back(std::move(reason));
  }
}

bool matches_any(const std::vector<std::string>& patterns, const std::string& id) {
  return std::any_of(patterns.begin(), patterns.end(),
                     [&](const std::string& pattern) { return matches(pattern, id); });
}

/// What is wrong between the two files; empty: nothing.
std::string disagreement(const Published& published) {
  for (const char* needed :
       {"grid.hosts", "grid.participants_per_host", "grid.endpoints_per_participant",
        "high_load.participants_per_host_min", "high_load.endpoints_per_participant_min"}) {
    const PublishedFigure* figure = published.find(needed);
    if (figure == nullptr || figure->values.empty()) return fmt::format("lacks '{}'", needed);
    for (const double value : figure->values) {
      if (value < 1 || value > 1000 || value != std::floor(value)) {
        return fmt::format("{}: {} is not a whole number from 1 to 1000", needed, value);
      }
    }
  }
  for (const PublishedFigure& figure : published.figures) {
    const auto notes =
        std::count_if(published.notes.begin(), published.notes.end(),
                      [&](const Note& note) { return matches_any(note.patterns, figure.id); });
    if (notes != 1) return fmt::format("{}: {} notes in 'beside', expected one", figure.id, notes);
  }
  const auto used = [&](const std::string& pattern) {
    return std::any_of(published.figures.begin(), published.figures.end(),
                       [&](const PublishedFigure& figure) { return matches(pattern, figure.id); });
  };
  std::vector<std::string> patterns;
  for (const Note& note : published.notes) {
    patterns.insert(patterns.end(), note.patterns.begin(), note.patterns.end());
  }
  for (const Reason& reason : published.reasons) {
    patterns.insert(patterns.end(), reason.patterns.begin(), reason.patterns.end());
  }
  for (const std::string& pattern : patterns) {
    if (!used(pattern)) return fmt::format("'{}' matches no published figure", pattern);
  }
  return {};
}

}  // namespace

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::input:
      return "input";
    case Kind::model:
      return "model";
    case Kind::nearest:
      return "nearest";
    case Kind::unavailable:
      return "unavailable";
  }
  std::abort();
}

bool matches(const std::string& pattern, const std::string& id) {
  std::istringstream parts{pattern};
  std::istringstream names{id};
  std::string part;
  std::string name;
  while (true) {
    const bool more = static_cast<bool>(std::getline(parts, part, '.'));
    if (more != static_cast<bool>(std::getline(names, name, '.'))) return false;
    if (!more) return true;
    if (part != "*" && part != name) return false;
  }
}

const PublishedFigure* Published::find(const std::string& id) const {
  const auto found = std::find_if(figures.begin(), figures.end(),
                                  [&](const PublishedFigure& figure) { return figure.id == id; });
  return found == figures.end() ? nullptr : &*found;
}

const std::vector<double>& Published::values(const std::string& id) const {
  static const std::vector<double> none;
  const PublishedFigure* figure = find(id);
  return figure == nullptr ? none : figure->values;
}

const Note& Published::note_of(const std::string& id) const {
  for (const Note& note : notes) {
    if (matches_any(note.patterns, id)) return note;
  }
  fmt::print(stderr, "internal error: the published figure {} has no note\n", id);
  std::_Exit(70);
}

std::vector<std::size_t> Published::reasons_of(const std::string& id) const {
  std::vector<std::size_t> positions;
  for (std::size_t k = 0; k < reasons.size(); ++k) {
    if (matches_any(reasons[k].patterns, id)) positions.push_back(k);
  }
  return positions;
}

std::vector<std::size_t> Published::reasons_of(const std::string& id,
                                               const std::string& variant) const {
  std::vector<std::size_t> positions;
  for (const std::size_t k : reasons_of(id)) {
    const std::vector<std::string>& only = reasons[k].variants;
    if (only.empty() || std::find(only.begin(), only.end(), variant) != only.end()) {
      positions.push_back(k);
    }
  }
  return positions;
}

Result<Published> parse_published(const std::string& tables, const std::string& notes,
                                  const std::string& source) {
  Published published;
  std::string file = source + "/paper-tables.yaml";
  try {
    collect(YAML::Load(tables), "", published.figures);
    file = source + "/paper-notes.yaml";
    read_notes(YAML::Load(notes), published);
  } catch (const Mistake& mistake) {
    return InputError{fmt::format("{}:{}:{}", file, mistake.mark.line + 1, mistake.mark.column + 1),
                      mistake.message};
  } catch (const YAML::Exception& error) {
    return InputError{fmt::format("{}:{}:{}", file, error.mark.line + 1, error.mark.column + 1),
                      error.msg};
  }
  if (const std::string wrong = disagreement(published); !wrong.empty()) {
    return InputError{source, wrong};
  }
  return published;
}

Result<Published> read_published(const SpecPath& specs) {
  for (const std::string& directory : specs.directories) {
    const std::string folder = directory + "/published";
    std::ifstream tables{folder + "/paper-tables.yaml"};
    std::ifstream notes{folder + "/paper-notes.yaml"};
    if (!tables || !notes) continue;
    std::stringstream tables_text;
    std::stringstream notes_text;
    tables_text << tables.rdbuf();
    notes_text << notes.rdbuf();
    return parse_published(tables_text.str(), notes_text.str(), folder);
  }
  return InputError{"specs/published", "paper-tables.yaml and paper-notes.yaml were not found"};
}

}  // namespace stormproof::reproduce
