// What users write (names of files and profiles, values) goes into reports of many formats. Each
// format escapes in its own way, but first every text has to be text: valid UTF-8 without control
// characters, which XML and HTML cannot hold at all.
#pragma once

#include <string>
#include <string_view>

namespace stormproof::report {

/// `text` with U+FFFD for what is not UTF-8, without control characters except line feed and tab,
/// and without the characters that reverse the direction of what follows.
[[nodiscard]] std::string valid_text(std::string_view text);

/// The same on one line: white space of every kind becomes single spaces.
[[nodiscard]] std::string one_line(std::string_view text);

/// "1 participant", "3 participants".
[[nodiscard]] std::string plural(std::size_t count, std::string_view noun);

/// `text` as one word of a POSIX shell, quoted only where that is needed.
[[nodiscard]] std::string shell_word(std::string_view text);

}  // namespace stormproof::report
