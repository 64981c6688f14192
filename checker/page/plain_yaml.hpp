// Reads the YAML that scenarios and profiles are written in, for the page that simulates: there
// yaml-cpp, which model/config/tree/yaml_text reads with, cannot be linked. What it accepts it
// reads as yaml_text does, to the place of every value, and what it does not know it refuses
// (tests/checker/page/plain_yaml_test.cpp compares them on every file that is shipped).
#pragma once

#include <string>
#include <string_view>

#include "model/config/tree/tree.hpp"

namespace stormproof::page {

/// Block and flow maps and lists, plain text over several lines, quoted text in one line, folded
/// text (">-") and comments. Errors, with line and column: anything else (anchors, aliases, tags,
/// several documents, tabs before a key), keys that are given twice, more than `max_tree_depth`
/// levels.
[[nodiscard]] model::config::Result<model::config::Node> parse_plain_yaml(
    std::string_view text, const std::string& source);

}  // namespace stormproof::page
