// Sources have comments of one line only.
#include "tests/structure/words.hpp"

#include <algorithm>

namespace stormproof::structure {

std::string code_of(const std::string& text, Quoted quoted) {
  std::string code;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text.compare(at, 2, "//") == 0) at = std::min(text.find('\n', at), text.size());
    if (at < text.size()) code += text[at];
    if (at >= text.size() || text[at] != '"') continue;
    const std::size_t begin = at + 1;
    if (at > 0 && text[at - 1] == 'R') {
      const std::string end = ")" + text.substr(begin, text.find('(', at) - begin) + "\"";
      at = std::min(text.find(end, at), text.size() - end.size()) + end.size() - 1;
    } else {
      while (++at < text.size() && text[at] != '"') at += text[at] == '\\' ? 1U : 0U;
    }
    if (quoted == Quoted::kept) code += text.substr(begin, at - begin);
    code += '"';
  }
  return code;
}

}  // namespace stormproof::structure
