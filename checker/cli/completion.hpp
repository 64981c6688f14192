// What is made from the parser for others to read: the scripts that complete commands in shells,
// and the manual page.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace stormproof::cli {

/// For bash and zsh: the commands, the options of each, names of shipped files, and files.
[[nodiscard]] std::string bash_completion(const CLI::App& program);
[[nodiscard]] std::string zsh_completion(const CLI::App& program);
/// For fish: the same with the help of each command and option, without names of shipped files.
[[nodiscard]] std::string fish_completion(const CLI::App& program);
/// stormproof(1), in roff.
[[nodiscard]] std::string man_page(const CLI::App& program);

}  // namespace stormproof::cli
