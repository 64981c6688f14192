#include "tests/cli/shown.hpp"

#include <cstdlib>
#include <fstream>
#include <istream>
#include <span>

#include <sys/wait.h>

namespace shown {

namespace fs = std::filesystem;

namespace {

bool match(std::span<const std::string> expected, std::span<const std::string> actual) {
  if (expected.empty()) return actual.empty();
  if (expected.front() == "...") {
    return match(expected.subspan(1), actual) ||
           (!actual.empty() && match(expected, actual.subspan(1)));
  }
  return !actual.empty() && expected.front() == actual.front() &&
         match(expected.subspan(1), actual.subspan(1));
}

std::vector<std::string> lines_in(const fs::path& file) {
  std::ifstream in{file};
  return lines_of(in);
}

}  // namespace

std::vector<std::string> lines_of(std::istream& in) {
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

Output run(const std::string& command, const fs::path& working, const fs::path& folder) {
  const std::string shell = "cd '" + working.string() + "' && TMP='" + folder.string() +
                            "' PATH='" + fs::path{STORMPROOF_PROGRAM}.parent_path().string() +
                            "':$PATH && { " + command + "\n} >'" + (folder / "out").string() +
                            "' 2>'" + (folder / "err").string() + "' </dev/null";
  const int status = std::system(shell.c_str());
  return {lines_in(folder / "out"), lines_in(folder / "err"),
          WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status)};
}

bool matches(const std::vector<std::string>& expected, const std::vector<std::string>& actual) {
  return match(expected, actual);
}

}  // namespace shown
