// Asks the terminal itself.
#include "checker/cli/terminal.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include <sys/ioctl.h>
#include <unistd.h>

namespace stormproof::cli {

report::Terminal standard_output() {
  report::Terminal terminal;
  if (isatty(STDOUT_FILENO) == 0) return terminal;
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string_view{value == nullptr ? "" : value};
  };
  terminal.colours = variable("NO_COLOR").empty() && variable("TERM") != "dumb";
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
    terminal.columns = std::clamp<std::size_t>(size.ws_col, 60, 120);
  }
  return terminal;
}

}  // namespace stormproof::cli
