// A declaration is told from a call by what stands before the name: the end of a type.
#include "tests/structure/host_functions.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include <fmt/core.h>

namespace stormproof::structure {
namespace {

constexpr std::array<std::string_view, 23> asked_for{
    "answer", "assign", "assign_each", "assign_word", "bits",  "cancel",   "changed",   "driver",
    "emit",   "fact",   "is_due",      "knob",        "moved", "owner_of", "pending",   "perform",
    "renew",  "said",   "schedule",    "state",       "value", "word",     "lane_order"};
/// What can stand before a call and looks like a type.
constexpr std::array<std::string_view, 6> no_types{"return", "else",     "new",
                                                   "case",   "co_yield", "throw"};

bool is_name(char one) { return std::isalnum(static_cast<unsigned char>(one)) != 0 || one == '_'; }
bool is_blank(char one) { return std::isspace(static_cast<unsigned char>(one)) != 0; }

std::string without_comments(const std::string& text) {
  std::string code;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text.compare(k, 2, "//") == 0) k = std::min(text.find('\n', k), text.size() - 1);
    code += text[k];
  }
  return code;
}

/// Whether a type ends where the text ends.
bool ends_with_type(std::string_view text) {
  const std::size_t all = text.size();
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  const bool is_apart = text.size() < all;
  // Those of operators stand apart on both sides.
  std::size_t marks = 0;
  while (!text.empty() && (text.back() == '&' || text.back() == '*'))
    text.remove_suffix(1), ++marks;
  if (text.empty() || !is_apart || marks > 1) return false;
  if (text.back() == '>') return text.size() > 1 && text[text.size() - 2] != '-';
  if (!is_name(text.back())) return false;
  std::size_t begin = text.size();
  while (begin > 0 && is_name(text[begin - 1])) --begin;
  return std::ranges::find(no_types, text.substr(begin)) == no_types.end();
}

}  // namespace

std::size_t count_host_functions(const std::string& text) {
  const std::string code = without_comments(text);
  std::size_t count = 0;
  for (std::size_t open = code.find('('); open != std::string::npos;
       open = code.find('(', open + 1)) {
    std::size_t begin = open;
    while (begin > 0 && is_name(code[begin - 1])) --begin;
    const std::string_view name = std::string_view{code}.substr(begin, open - begin);
    if (std::ranges::find(asked_for, name) == asked_for.end()) continue;
    if (ends_with_type(std::string_view{code}.substr(0, begin))) ++count;
  }
  return count;
}

std::vector<std::string> check_hosts(const Texts& texts, const HostFunctions& most) {
  std::vector<std::string> complaints;
  for (const auto& [file, limit] : most) {
    const auto found = texts.find(file);
    const std::size_t count = found == texts.end() ? 0 : count_host_functions(found->second);
    if (count == 0) {
      complaints.push_back(fmt::format("{} has none, and need not be in the list", file));
    } else if (count > limit) {
      complaints.push_back(
          fmt::format("{} has {} functions that a world asks for, and had {}", file, count, limit));
    }
  }
  for (const auto& [file, text] : texts) {
    if (most.contains(file) || count_host_functions(text) == 0) continue;
    for (const char* store : {"public Stored<", "public model::Stored<", "public model::Kept<"}) {
      if (text.find(store) == std::string::npos) continue;
      complaints.push_back(fmt::format("{} has a store, and is not in the list", file));
      break;
    }
  }
  return complaints;
}

}  // namespace stormproof::structure
