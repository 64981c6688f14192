// YAML (and so JSON) text to a tree that knows its places. Scenario files are small and written by
// hand, so what this accepts is deliberately narrow: one document, unique keys, no tags, bounded
// depth and size.
#pragma once

#include <string>
#include <string_view>

#include "model/config/tree/tree.hpp"

namespace stormproof::model::config {

inline constexpr std::size_t max_file_bytes = 16 * 1024 * 1024;
/// Nodes of one tree, aliases counted as often as they are used.
inline constexpr std::size_t max_tree_nodes = 1'000'000;

/// Reads one YAML document. `source` is the name in error messages. Errors, each with line and
/// column: invalid YAML or UTF-8, control characters, duplicate keys, keys that are not text, tags,
/// several documents, a text, depth or number of nodes over the limits.
[[nodiscard]] Result<Node> parse_yaml(std::string_view text, const std::string& source);

/// Reads a file; in addition to the errors of `parse_yaml`: not readable, a directory, longer than
/// 16 MiB.
[[nodiscard]] Result<Node> load_yaml(const std::string& path);

/// `text` as a quoted YAML scalar, whatever is in it.
[[nodiscard]] std::string quoted_scalar(std::string text);

}  // namespace stormproof::model::config
