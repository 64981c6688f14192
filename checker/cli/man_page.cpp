// The manual page: the help of every command, as the parser has it.
#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "checker/cli/completion.hpp"

namespace stormproof::cli {

namespace {

/// `text` as it stands: no line of it is a request of roff, no backslash an escape.
std::string verbatim(const std::string& text) {
  std::string roff;
  bool line_starts = true;
  for (const char c : text) {
    if (line_starts && (c == '.' || c == '\'')) roff += "\\&";
    line_starts = c == '\n';
    if (c == '\\') {
      roff += "\\e";
    } else if (c == '-') {
      roff += "\\-";
    } else {
      roff += c;
    }
  }
  return roff;
}

void add(const CLI::App& command, const std::string& path, std::string& page) {
  for (const CLI::App* below : command.get_subcommands({})) {
    const std::string name = path + " " + below->get_name();
    if (below->get_subcommands({}).empty()) {
      const std::string help =
          below->get_formatter()->make_help(below, name, CLI::AppFormatMode::Normal);
      page += fmt::format(".SS {}\n.nf\n{}.fi\n", verbatim(name), verbatim(help));
    }
    add(*below, name, page);
  }
}

}  // namespace

std::string man_page(const CLI::App& program) {
  std::string page = fmt::format(
      ".TH STORMPROOF 1 \"\" \"stormproof {}\" \"User Commands\"\n"
      ".SH NAME\nstormproof \\- checks whether a ROS 2 / DDS system discovers itself in time\n"
      ".SH SYNOPSIS\n.B stormproof\n.I COMMAND\n[OPTION]...\n"
      ".SH DESCRIPTION\n"
      "When many DDS participants start on a shared wireless channel, discovery messages queue "
      "up,\n"
      "reliability timers expire, and repairs join the same queue: a discovery storm. stormproof\n"
      "simulates that loop exactly, before deployment, checks which guarantees hold, and reads\n"
      "captures of real discovery.\n"
      ".SH COMMANDS\n",
      STORMPROOF_VERSION);
  add(program, program.get_name(), page);
  page +=
      ".SH ENVIRONMENT\n"
      ".TP\nSTORMPROOF_SPECS\nFolders with scenarios and profiles of your own, separated by "
      "colons; they come before the installed ones.\n"
      ".TP\nNO_COLOR\nNo colours at a terminal.\n"
      ".SH FILES\n.TP\n/usr/share/stormproof/specs\nScenarios, profiles, grids, captures, and "
      "the guide.\n";
  return page;
}

}  // namespace stormproof::cli
