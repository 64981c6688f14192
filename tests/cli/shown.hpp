// What a document shows of the command line: a command and its output, in which a line "..." stands
// for any number of lines. Golden files and the pages of the guide are compared this way.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace shown {

struct Output {
  std::vector<std::string> out;
  std::vector<std::string> err;
  int exit_code = 0;
};

[[nodiscard]] std::vector<std::string> lines_of(std::istream& in);

/// Runs the shell command in `working` with the program on the path; $TMP is `folder`, which also
/// takes the output until it is read.
[[nodiscard]] Output run(const std::string& command, const std::filesystem::path& working,
                         const std::filesystem::path& folder);

/// Whether `actual` is `expected`, where "..." stands for any number of lines.
[[nodiscard]] bool matches(const std::vector<std::string>& expected,
                           const std::vector<std::string>& actual);

}  // namespace shown
