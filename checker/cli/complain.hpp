// How a command refuses its input: one line on standard error, and the exit code for it.
#pragma once

#include <string>
#include <string_view>

#include "checker/cli/exit_code.hpp"

namespace stormproof::cli {

/// `text` as a terminal may have it: control characters, which names of files can hold, become
/// "\x1b"; line feeds stay.
[[nodiscard]] std::string visible(std::string_view text);

/// Says what is wrong, with its place and what was expected; returns ExitCode::bad_input.
int complain(const std::string& message);

}  // namespace stormproof::cli
