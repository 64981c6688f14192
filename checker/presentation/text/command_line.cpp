// Looks for the program where the reader's shell would.
#include "checker/presentation/text/command_line.hpp"

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include <unistd.h>

#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::report {

namespace {

namespace fs = std::filesystem;

constexpr const char* own_name = "stormproof";

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// What a shell runs for "stormproof"; empty: nothing.
fs::path on_path() {
  std::istringstream folders{variable("PATH")};
  for (std::string folder; std::getline(folders, folder, ':');) {
    fs::path file = fs::path{folder.empty() ? "." : folder} / own_name;
    std::error_code ignored;
    if (fs::is_regular_file(file, ignored) && access(file.c_str(), X_OK) == 0) return file;
  }
  return {};
}

std::string& name() {
  static std::string name{own_name};
  return name;
}

}  // namespace

void set_program(const std::string& called) {
  const std::string by_launcher = variable("STORMPROOF_CALLED");
  const std::string& as = by_launcher.empty() ? called : by_launcher;
  const fs::path found = on_path();
  std::error_code ignored;
  const bool reached = !found.empty() && fs::equivalent(found, as, ignored);
  const bool looked_up = as.find('/') == std::string::npos;
  const bool absolute = as.starts_with('/');
  name() = as.empty() || looked_up || reached || absolute ? own_name : as;
}

const std::string& program() { return name(); }

std::string command_line(const std::vector<std::string>& words) {
  std::string line = shell_word(program());
  for (const std::string& word : words) line += " " + shell_word(word);
  return line;
}

}  // namespace stormproof::report
