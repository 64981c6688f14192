// What the program prints on a terminal: colours and the terminal's width; in a pipe neither.
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

namespace stormproof::cli {
namespace terminal_test {

/// The output of `properties`, or of another command, on a terminal of so many columns, with a
/// variable of the environment set.
std::string on_a_terminal(unsigned short columns, const char* name, const char* value,
                          const char* shell_line = nullptr) {
  const winsize size{24, columns, 0, 0};
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
  if (child == 0) {
    setenv("TERM", "xterm", 1);
    unsetenv("NO_COLOR");
    setenv(name, value, 1);
    if (shell_line != nullptr) execl("/bin/sh", "sh", "-c", shell_line, nullptr);
    execl(STORMPROOF_PROGRAM, "stormproof", "properties", nullptr);
    _exit(127);
  }
  std::string text;
  char buffer[4096];
  // Linux ends the reading of a terminal whose other side is gone with an error.
  for (ssize_t n = 0; (n = read(terminal, buffer, sizeof buffer)) > 0;) {
    text.append(buffer, static_cast<std::size_t>(n));
  }
  close(terminal);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_NE(WEXITSTATUS(status), 127);
  return text;
}

/// Characters (not bytes) of the longest line, without escape sequences.
std::size_t widest(const std::string& text) {
  std::size_t widest = 0;
  std::size_t width = 0;
  bool in_escape = false;
  for (const char c : text) {
    if (c == '\n' || c == '\r') {
      width = 0;
    } else if (c == '\033') {
      in_escape = true;
    } else if (in_escape) {
      in_escape = c != 'm';
    } else if ((static_cast<unsigned char>(c) & 0xC0U) != 0x80U) {
      widest = std::max(widest, ++width);
    }
  }
  return widest;
}

TEST(Terminal, HasColours) {
  EXPECT_NE(on_a_terminal(80, "UNUSED", "").find("\033["), std::string::npos);
}

TEST(Terminal, HasNoneIfNotWanted) {
  EXPECT_EQ(on_a_terminal(80, "NO_COLOR", "1").find('\033'), std::string::npos);
  EXPECT_EQ(on_a_terminal(80, "TERM", "dumb").find('\033'), std::string::npos);
}

TEST(Terminal, AnEmptyNoColorIsNotSet) {
  EXPECT_NE(on_a_terminal(80, "NO_COLOR", "").find("\033["), std::string::npos);
}

TEST(Terminal, ItsWidthIsUsedWithinLimits) {
  const std::size_t narrow = widest(on_a_terminal(60, "UNUSED", ""));
  const std::size_t wide = widest(on_a_terminal(110, "UNUSED", ""));
  EXPECT_LE(narrow, 60U);
  EXPECT_GT(wide, 80U);
  EXPECT_LE(wide, 110U);
  EXPECT_LE(widest(on_a_terminal(400, "UNUSED", "")), 120U);
}

/// The texts that took each other's place on the progress line.
TEST(Terminal, TheProgressLineFits) {
  constexpr unsigned short columns = 31;
  const std::string shown = on_a_terminal(
      columns, "UNUSED", "",
      "timeout -s INT 3 " STORMPROOF_PROGRAM
      " simulate high-load-6x30 --set "
      "deployment.participants_per_host=90 --set time_limit=100000s >/dev/null; true");
  const std::string renewed = "\r\033[K";
  std::size_t texts = 0;
  for (std::size_t at = shown.find(renewed); at != std::string::npos;) {
    const std::size_t begin = at + renewed.size();
    at = shown.find(renewed, begin);
    const std::string text = shown.substr(begin, at == std::string::npos ? 0 : at - begin);
    EXPECT_LT(widest(text), columns) << text;
    if (!text.empty()) ++texts;
  }
  EXPECT_GE(texts, 2U) << shown;
  EXPECT_NE(shown.find("…"), std::string::npos) << shown;
}

/// `q` leaves, and the terminal is what it was.
TEST(Terminal, WatchTakesItAndGivesItBack) {
  const std::string shown = on_a_terminal(
      80, "UNUSED", "",
      "cd \"${TMPDIR:-/tmp}\"; { sleep 2; echo q; } | script -qec '" STORMPROOF_PROGRAM
      " watch --interface lo --for 20s' /dev/null; true");
  if (shown.find("setcap") != std::string::npos) return;  // nobody may capture here
  EXPECT_NE(shown.find("q quits"), std::string::npos) << shown;
  const auto taken = shown.find("\033[?1049h");
  const auto given_back = shown.find("\033[?1049l");
  ASSERT_NE(taken, std::string::npos) << shown;
  ASSERT_NE(given_back, std::string::npos) << shown;
  EXPECT_LT(taken, given_back);
}

}  // namespace terminal_test
}  // namespace stormproof::cli
