// Examples of each command, for its help. Every line runs as it stands where `specs` is, and a test
// runs it.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace stormproof::cli {

struct Example {
  std::string_view line;  ///< for a shell
  std::string_view what;  ///< it shows
};

/// Those of "check", "profile show", …; none for what is no command.
[[nodiscard]] std::span<const Example> examples_of(std::string_view command);

/// As they stand below the help of a command: "Examples:", then a line and what it shows, each.
[[nodiscard]] std::string examples_text(std::string_view command);

/// What `stormproof` alone says: the three jobs it is for, and where to read on.
[[nodiscard]] std::string front_page();

}  // namespace stormproof::cli
