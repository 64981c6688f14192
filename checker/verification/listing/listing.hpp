// `stormproof list` without its command line: everything that is called by a name, with one line
// about it. Descriptions are those of the files and tables themselves.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"
#include "model/config/spec_path.hpp"

namespace stormproof::listing {

struct Entry {
  std::string name;       ///< as a command takes it: a name, or a path
  std::string what;       ///< one line
  std::string file = {};  ///< that it is read from; empty: it is part of the program
};

struct List {
  std::string_view kind;   ///< "scenarios"
  std::string_view where;  ///< where such a name goes
  std::vector<Entry> entries;
};

/// What can be listed, in this order.
[[nodiscard]] std::span<const std::string_view> kinds();

/// One list, of a kind that is among `kinds`. A file that cannot be read has the reason in place of
/// its description.
[[nodiscard]] List list_of(std::string_view kind, const model::config::SpecPath& specs);

[[nodiscard]] report::Document document_of(const std::vector<List>& lists);

/// Keys: lists (kind, where, entries: name, what, file or null).
[[nodiscard]] nlohmann::ordered_json to_json(const std::vector<List>& lists);
[[nodiscard]] nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions);

}  // namespace stormproof::listing
