// Ids of effects in few words.
#pragma once

#include <string>
#include <vector>

namespace stormproof::tables {

/// "AckNackArrives.1-3, Hear.7": ids in their order, numbers that follow each other together.
[[nodiscard]] inline std::string listed_effects(const std::vector<std::string>& ids) {
  std::string text;
  for (std::size_t k = 0; k < ids.size();) {
    const std::string rule = ids[k].substr(0, ids[k].rfind('.') + 1);
    const unsigned long first = std::stoul(ids[k].substr(rule.size()));
    std::size_t more = 1;
    while (k + more < ids.size() && ids[k + more] == rule + std::to_string(first + more)) ++more;
    text += (text.empty() ? "" : ", ") + ids[k];
    if (more > 1) text += "-" + std::to_string(first + more - 1);
    k += more;
  }
  return text;
}

}  // namespace stormproof::tables
