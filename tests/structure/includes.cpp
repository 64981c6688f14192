// Line by line: an #include stands alone on its line, and none of the sources hides one in a
// comment of several lines.
#include "tests/structure/includes.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

namespace stormproof::structure {
namespace fs = std::filesystem;

namespace {

constexpr const char* blanks = " \t";

/// The text without the blanks in front of it.
std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string::npos ? std::string{} : text.substr(first);
}

std::string content(const fs::path& file) {
  std::ifstream in{file};
  return {std::istreambuf_iterator<char>{in}, {}};
}

}  // namespace

std::vector<std::string> includes_of(const std::string& text) {
  std::vector<std::string> names;
  std::istringstream lines{text};
  for (std::string line; std::getline(lines, line);) {
    std::string rest = trimmed(line);
    if (!rest.starts_with('#')) continue;
    rest = trimmed(rest.substr(1));
    if (!rest.starts_with("include")) continue;
    rest = trimmed(rest.substr(7));
    const std::size_t end = rest.find_first_of("\">", 1);
    const bool is_name = rest.starts_with('"') || rest.starts_with('<');
    if (is_name && end != std::string::npos) names.push_back(rest.substr(1, end - 1));
  }
  return names;
}

Texts read_texts(const std::string& root, const std::vector<std::string>& folders) {
  Texts texts;
  for (const std::string& folder : folders) {
    for (const fs::directory_entry& entry :
         fs::recursive_directory_iterator{fs::path{root} / folder}) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".hpp" && extension != ".cpp") continue;
      texts[fs::relative(entry.path(), root).generic_string()] = content(entry.path());
    }
  }
  return texts;
}

Includes includes_of(const Texts& texts) {
  Includes includes;
  for (const auto& [file, text] : texts) includes[file] = includes_of(text);
  return includes;
}

std::vector<std::vector<std::string>> read_words(const std::string& file) {
  std::vector<std::vector<std::string>> list;
  std::istringstream lines{content(file)};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream rest{line.substr(0, line.find('#'))};
    std::vector<std::string> words{std::istream_iterator<std::string>{rest}, {}};
    if (!words.empty()) list.push_back(std::move(words));
  }
  return list;
}

}  // namespace stormproof::structure
