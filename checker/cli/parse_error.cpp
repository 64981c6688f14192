// CLI11 knows what it could not parse; this says what was probably meant.
#include "checker/cli/parse_error.hpp"

#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "model/config/tree/suggestion.hpp"

namespace stormproof::cli {

namespace {

using model::config::suggestion;

/// The command that the words have led to.
const CLI::App& innermost(const CLI::App& program) {
  const CLI::App* app = &program;
  while (!app->get_subcommands().empty()) app = app->get_subcommands().front();
  return *app;
}

/// "profile show"; empty for the program itself.
std::string path_of(const CLI::App& command) {
  std::string path;
  for (const CLI::App* app = &command; app->get_parent() != nullptr; app = app->get_parent()) {
    path = app->get_name() + (path.empty() ? "" : " " + path);
  }
  return path;
}

/// "--samples", "-v".
std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

/// What no option and no positional takes.
std::string unexpected(const CLI::App& program, const CLI::App& command) {
  const std::vector<std::string> words = program.remaining(true);
  const auto option =
      std::ranges::find_if(words, [](const std::string& word) { return word.starts_with('-'); });
  if (option == words.end()) {
    return fmt::format("'{}' was not expected", words.empty() ? "" : words.front());
  }
  const std::string name = option->substr(0, option->find('='));
  return fmt::format("'{}' is not an option{}", name, suggestion(name, options_of(command)));
}

std::vector<std::string> commands_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

}  // namespace

std::string said_of(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App& command = innermost(program);
  const std::string path = path_of(command);
  const bool is_extra = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  const std::string what = is_extra ? unexpected(program, command) : std::string{error.what()};
  if (path.empty()) return fmt::format("{}; see 'stormproof help'", what);
  return fmt::format("{}: {}; see 'stormproof help {}'", path, what, path);
}

std::string no_command(const CLI::App& program, const std::vector<std::string>& words) {
  const CLI::App* app = &program;
  for (const std::string& word : words) {
    const std::vector<std::string> commands = commands_of(*app);
    if (commands.empty() || word.empty() || word.front() == '-') return {};
    const auto found = std::ranges::find(commands, word);
    if (found == commands.end()) {
      const std::string path = path_of(*app);
      return fmt::format("'{}{}' is not a command; expected one of {}{}",
                         path.empty() ? "" : path + " ", word, fmt::join(commands, ", "),
                         suggestion(word, commands));
    }
    app = app->get_subcommands({})[static_cast<std::size_t>(found - commands.begin())];
  }
  return {};
}

}  // namespace stormproof::cli
