// What is wrong with a command line, in the words of all other messages.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace stormproof::cli {

/// Of what the parser refused: the command, what is wrong, the nearest option if one was misspelt,
/// and where the command is explained.
[[nodiscard]] std::string said_of(const CLI::App& program, const CLI::ParseError& error);

/// "'simulat' is not a command; expected one of …; did you mean 'simulate'?" if the words before
/// the first option name no command below `program`; empty if they do. Words behind a command that
/// has none below it are its own.
[[nodiscard]] std::string no_command(const CLI::App& program,
                                     const std::vector<std::string>& words);

}  // namespace stormproof::cli
