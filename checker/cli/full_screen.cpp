#include "checker/cli/full_screen.hpp"

#include <clocale>
#include <sstream>

#define NCURSES_NOMACROS  // they would rename the functions of others
#include <ncurses.h>

namespace stormproof::cli {

FullScreen::FullScreen() {
  // Signs and units are UTF-8, whatever the surroundings say.
  if (std::setlocale(LC_CTYPE, "C.UTF-8") == nullptr) std::setlocale(LC_CTYPE, "");
  initscr();
  cbreak();
  noecho();
  curs_set(0);
  nodelay(stdscr, TRUE);
}

FullScreen::~FullScreen() { endwin(); }

std::size_t FullScreen::columns() { return static_cast<std::size_t>(getmaxx(stdscr)); }

void FullScreen::show(const std::string& text, const std::string& footer) {
  erase();
  std::istringstream lines{text};
  const int last = getmaxy(stdscr) - 1;
  int at = 0;
  for (std::string line; at < last && std::getline(lines, line); ++at) {
    mvaddstr(at, 0, line.c_str());
  }
  mvaddnstr(last, 0, footer.c_str(), getmaxx(stdscr) - 1);
  refresh();
}

int FullScreen::key() {
  const int pressed = getch();
  return pressed == ERR ? 0 : pressed;
}

}  // namespace stormproof::cli
