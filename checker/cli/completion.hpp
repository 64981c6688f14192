// The script that completes commands in a shell.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace stormproof::cli {

/// For bash: the commands, the options of each, and files for everything else.
[[nodiscard]] std::string bash_completion(const CLI::App& program);

}  // namespace stormproof::cli
