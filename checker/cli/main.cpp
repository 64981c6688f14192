// The program: parses arguments, runs the command, turns what nobody expected into exit code 70.
#include <algorithm>
#include <exception>
#include <new>

#include <fmt/core.h>

#include "checker/cli/command_line.hpp"
#include "checker/cli/exit_code.hpp"
#include "model/config/tree/suggestion.hpp"

namespace {

using namespace stormproof;

/// Whether the first argument is a word that is no command; says so, if it is.
bool names_no_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-' || argv[1][0] == '\0') return false;
  const std::string word = argv[1];
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands({})) commands.push_back(command->get_name());
  if (std::find(commands.begin(), commands.end(), word) != commands.end()) return false;
  std::string list;
  for (const std::string& command : commands) list += (list.empty() ? "" : ", ") + command;
  fmt::print(stderr, "stormproof: '{}' is not a command; expected one of {}{}\n", word, list,
             model::config::suggestion(word, commands));
  return true;
}

int run(int argc, char** argv) {
  CLI::App app{"stormproof: will these ROS 2 / DDS participants discover each other in time?"};
  app.name("stormproof");
  app.set_version_flag("--version", "stormproof " STORMPROOF_VERSION);
  app.require_subcommand(1);
  cli::Command chosen;
  cli::declare_commands(app, chosen);
  if (names_no_command(app, argc, argv)) return cli::bad_input;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? cli::established : cli::bad_input;
  }
  return chosen();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "stormproof: out of memory; try a smaller deployment or a shorter limit\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "stormproof: internal error: {}\n", error.what());
  }
  return cli::internal_error;
}
