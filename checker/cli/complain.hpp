// How a command refuses its input: one line on standard error, and the exit code for it.
#pragma once

#include <cstdio>
#include <string>

#include <fmt/core.h>

#include "checker/cli/exit_code.hpp"

namespace stormproof::cli {

/// Says what is wrong, with its place and what was expected; returns ExitCode::bad_input.
inline int complain(const std::string& message) {
  fmt::print(stderr, "stormproof: {}\n", message);
  return bad_input;
}

}  // namespace stormproof::cli
