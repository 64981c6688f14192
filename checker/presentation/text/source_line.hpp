// The line of a file that a remark is about, with a caret below the column. Files come from
// anywhere: control characters are not shown, and of a long line only what is near the column.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "model/config/tree/tree.hpp"

namespace stormproof::report {

/// Files that remarks are about. Each is read once, because a file may have as many remarks as
/// lines.
class SourceLines {
 public:
  /// Two lines of at most 100 columns, "  12 | <times>" and the caret; empty if there is no such
  /// line, or the file is not in an encoding whose characters are bytes or UTF-8.
  [[nodiscard]] std::string marked(const model::config::Place& place);

 private:
  struct Text {
    std::string bytes;
    std::vector<std::size_t> starts;  ///< of its lines, which end with LF, CR LF or CR
  };

  const Text& text_of(const std::string& path);

  std::map<std::string, Text> texts_;
};

/// The same for a line that is known. `column` counts bytes from 1.
[[nodiscard]] std::string marked_line(std::string_view line, int number, int column);

}  // namespace stormproof::report
