// What the program accepts: one function for each command declares its options and, once parsed,
// leaves the command to be run in `CommandLine::run`.
#pragma once

#include <functional>

#include <CLI/CLI.hpp>

namespace stormproof::cli {

/// The command that was asked for; returns its exit code.
using Command = std::function<int()>;

/// Declares all commands in `app`. Parsing sets `chosen`.
void declare_commands(CLI::App& app, Command& chosen);

}  // namespace stormproof::cli
