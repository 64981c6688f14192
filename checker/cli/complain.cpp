// Messages repeat what a user gave, and that may be a name that somebody else chose: escape codes
// in it reach no terminal.
#include "checker/cli/complain.hpp"

#include <fmt/core.h>

#include "checker/cli/streams.hpp"

namespace stormproof::cli {

std::string visible(std::string_view text) {
  std::string shown;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const auto byte = static_cast<unsigned char>(text[k]);
    const auto next = k + 1 < text.size() ? static_cast<unsigned char>(text[k + 1]) : 0U;
    if ((byte < 0x20 && byte != '\n') || byte == 0x7f) {
      shown += fmt::format("\\x{:02x}", byte);
    } else if (byte == 0xc2 && next >= 0x80 && next < 0xa0) {  // U+0080 to U+009F: control, too
      shown += fmt::format("\\u00{:02x}", next);
      ++k;
    } else {
      shown += text[k];
    }
  }
  return shown;
}

int complain(const std::string& message) {
  say("stormproof: " + visible(message));
  return bad_input;
}

}  // namespace stormproof::cli
