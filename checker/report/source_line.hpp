// The line of a file that a remark is about, with a caret below the column. Files come from
// anywhere: control characters are not shown, and of a long line only what is near the column.
#pragma once

#include <string>
#include <string_view>

#include "model/config/tree.hpp"

namespace stormproof::report {

/// Two lines of at most 100 columns, "  12 | <times>" and the caret; empty if there is no such
/// line.
[[nodiscard]] std::string source_line(const model::config::Place& place);

/// The same for a line that is known. `column` counts bytes from 1.
[[nodiscard]] std::string marked_line(std::string_view line, int number, int column);

}  // namespace stormproof::report
