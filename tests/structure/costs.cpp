// Words are found in paths, not in texts: who names a file after a vendor writes it for that
// vendor.
#include "tests/structure/costs.hpp"

#include <algorithm>
#include <set>

#include <fmt/core.h>

namespace stormproof::structure {
namespace {

bool is_between(char one) { return one == '/' || one == '_' || one == '.'; }

/// Whether a word of the path begins so: cyclone also stands for cyclonedds.
bool names(const std::string& path, const std::string& word) {
  for (std::size_t at = path.find(word); at != std::string::npos; at = path.find(word, at + 1)) {
    if (at == 0 || is_between(path[at - 1])) return true;
  }
  return false;
}

}  // namespace

VendorCost cost_of(const Texts& texts, const std::string& word) {
  VendorCost cost{word};
  std::set<std::string> folders;
  for (const auto& [file, text] : texts) {
    if (!names(file, word)) continue;
    cost.lines += static_cast<std::size_t>(std::ranges::count(text, '\n'));
    folders.insert(file.substr(0, file.rfind('/')));
  }
  cost.folders = folders.size();
  return cost;
}

std::vector<std::string> check_cost(const Texts& texts, const VendorCost& limit) {
  std::vector<std::string> complaints;
  const VendorCost cost = cost_of(texts, limit.word);
  const auto complain = [&](const std::string& of_what, std::size_t is, std::size_t most) {
    complaints.push_back(is > most ? fmt::format("{} has {} {}, at most {} are allowed", limit.word,
                                                 is, of_what, most)
                                   : fmt::format("{} has {} {}: the list can say less than {}",
                                                 limit.word, is, of_what, most));
  };
  const std::size_t margin = std::max<std::size_t>(limit.lines / 10, 20);
  if (cost.lines > limit.lines || cost.lines + margin < limit.lines) {
    complain("lines", cost.lines, limit.lines);
  }
  if (cost.folders != limit.folders) complain("folders", cost.folders, limit.folders);
  return complaints;
}

}  // namespace stormproof::structure
