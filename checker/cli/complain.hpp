// How a command refuses its input: one line on standard error, and the exit code for it.
#pragma once

#include <string>

#include "checker/cli/exit_code.hpp"
#include "checker/cli/streams.hpp"

namespace stormproof::cli {

/// Says what is wrong, with its place and what was expected; returns ExitCode::bad_input.
inline int complain(const std::string& message) {
  say("stormproof: " + message);
  return bad_input;
}

}  // namespace stormproof::cli
