// What stood on the command line, so that the program can say how to get the same answer again. It
// is read from the parser's results, so no option can be forgotten.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace stormproof::cli {

/// An option with its values, or a word that belongs to none.
struct Given {
  std::string option;               ///< "--set"; empty: `values` are positionals
  std::vector<std::string> values;  ///< none: a flag
};

/// What was given to `command`, in the order of declaration, without `left_out`. The first are the
/// program and the commands.
[[nodiscard]] std::vector<Given> given_to(const CLI::App& command,
                                          const std::vector<const CLI::Option*>& left_out);

/// One line for a shell. `without`: options that are left out.
[[nodiscard]] std::string shell_line(const std::vector<Given>& given,
                                     std::initializer_list<std::string_view> without = {});

}  // namespace stormproof::cli
