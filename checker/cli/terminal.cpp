// Asks the terminal itself.
#include "checker/cli/terminal.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include <sys/ioctl.h>
#include <unistd.h>

namespace stormproof::cli {

namespace {

std::optional<std::size_t> columns_of(int file) {
  winsize size{};
  if (ioctl(file, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return std::nullopt;
  return size.ws_col;
}

}  // namespace

report::Terminal standard_output() {
  report::Terminal terminal;
  if (isatty(STDOUT_FILENO) == 0) return terminal;
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string_view{value == nullptr ? "" : value};
  };
  terminal.colours = variable("NO_COLOR").empty() && variable("TERM") != "dumb";
  terminal.drops_columns = true;
  if (const auto columns = columns_of(STDOUT_FILENO)) {
    terminal.columns = std::clamp<std::size_t>(*columns, 60, 120);
  }
  return terminal;
}

std::optional<std::size_t> columns_of_errors() { return columns_of(STDERR_FILENO); }

}  // namespace stormproof::cli
