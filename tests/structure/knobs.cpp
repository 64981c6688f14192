// A knob is named where its key is a word of its own, whatever is around it: `dds.sedp.ack_delay`
// and "sedp.ack_delay" both name ack_delay.
#include "tests/structure/knobs.hpp"

#include <regex>
#include <set>

#include <fmt/core.h>

#include "tests/structure/words.hpp"

namespace stormproof::structure {

std::vector<std::string> knobs_of(const std::string& table) {
  const std::regex row{R"row(visit\.knob\(\s*"(\w+)")row"};
  std::set<std::string> keys;
  for (std::sregex_iterator at{table.begin(), table.end(), row}; at != std::sregex_iterator{};
       ++at) {
    keys.insert((*at)[1]);
  }
  return {keys.begin(), keys.end()};
}

std::vector<std::string> check_knobs(const std::vector<std::string>& knobs, const Texts& texts,
                                     std::size_t usual,
                                     const std::map<std::string, std::size_t>& listed) {
  std::map<std::string, std::size_t> files;
  for (const std::string& knob : knobs) files[knob] = 0;
  for (const auto& [file, text] : texts) {
    std::set<std::string> said;
    for_words(code_of(text, Quoted::kept),
              [&](std::string_view word, std::size_t) { said.emplace(word); });
    for (auto& [knob, count] : files) count += said.contains(knob) ? 1U : 0U;
  }
  std::vector<std::string> complaints;
  for (const auto& [knob, count] : files) {
    const auto found = listed.find(knob);
    const std::size_t most = found == listed.end() ? usual : found->second;
    if (count > most) {
      complaints.push_back(fmt::format("{} is named in {} files, not {}", knob, count, most));
    } else if (found != listed.end() && count < most) {
      complaints.push_back(
          fmt::format("{} is listed with {} files, and needs {}", knob, most, count));
    }
  }
  for (const auto& [knob, count] : listed) {
    if (!files.contains(knob)) complaints.push_back(fmt::format("{} is listed and no knob", knob));
  }
  return complaints;
}

}  // namespace stormproof::structure
