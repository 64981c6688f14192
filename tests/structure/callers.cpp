// Words and the characters around them are enough: sources are formatted, so what stands at the
// beginning of a line of a .cpp file is no call.
#include "tests/structure/callers.hpp"

#include <algorithm>
#include <set>
#include <string_view>

#include <fmt/core.h>

#include "tests/structure/words.hpp"

namespace stormproof::structure {
namespace {

std::string_view line_before(std::string_view text, std::size_t at) {
  const std::size_t end = text.rfind('\n', at);
  const std::size_t begin = at == 0 || end == std::string_view::npos ? 0 : end + 1;
  return text.substr(begin, at - begin);
}

/// Where a header says "Type name(" or "Type& name(".
bool is_declared(std::string_view text, std::string_view word, std::size_t at) {
  if (!text.substr(at + word.size()).starts_with('(')) return false;
  std::string_view before = line_before(text, at);
  if (!before.empty() && before.back() != ' ' && before.back() != '&' && before.back() != '*') {
    return false;
  }
  while (!before.empty() && std::string_view{" &*"}.find(before.back()) != before.npos) {
    before.remove_suffix(1);
  }
  if (before.empty() || (!is_of_word(before.back()) && before.back() != '>')) return false;
  std::size_t begin = before.size();
  while (begin > 0 && is_of_word(before[begin - 1])) --begin;
  const std::set<std::string_view> no_types{"return", "else", "new", "throw", "case", "co_return"};
  return !no_types.contains(before.substr(begin));
}

/// Where a .cpp file defines a function: at the beginning of a line.
bool is_defined(std::string_view text, std::string_view word, std::size_t at) {
  const std::string_view before = line_before(text, at);
  const bool is_indented = !before.empty() && before.front() == ' ';
  return !is_indented && text.substr(at + word.size()).starts_with('(') &&
         before.find_first_of(";={}()") == before.npos;
}

/// Where a word stands: as the declaration or definition of a function, or as anything else.
struct Places {
  std::vector<std::string> declared;
  std::size_t defined = 0;
  std::size_t other = 0;
};

}  // namespace

std::vector<std::string> check_callers(const Texts& texts,
                                       const std::vector<std::string>& allowed) {
  std::map<std::string, Places, std::less<>> words;
  for (const auto& [file, text] : texts) {
    const std::string code = code_of(text);
    const bool is_header = file.ends_with(".hpp");
    for_words(code, [&, &file = file](std::string_view word, std::size_t at) {
      auto found = words.find(word);
      if (found == words.end()) found = words.emplace(word, Places{}).first;
      if (is_header && is_declared(code, word, at)) {
        found->second.declared.push_back(file);
      } else if (!is_header && is_defined(code, word, at)) {
        ++found->second.defined;
      } else {
        ++found->second.other;
      }
    });
  }
  std::vector<std::string> complaints;
  std::set<std::string> unused{allowed.begin(), allowed.end()};
  for (const auto& [word, places] : words) {
    if (places.declared.size() != 1 || places.defined > 1 || places.other > 0) continue;
    const std::string& header = places.declared.front();
    const auto entry = std::ranges::find_if(allowed, [&](const std::string& one) {
      return one == word || (one.ends_with('/') && header.starts_with(one));
    });
    if (entry != allowed.end()) {
      unused.erase(*entry);
    } else {
      complaints.push_back(fmt::format("{} of {} is called by no source", word, header));
    }
  }
  for (const std::string& entry : unused) {
    complaints.push_back(fmt::format("{} need not be allowed to have no caller", entry));
  }
  return complaints;
}

}  // namespace stormproof::structure
