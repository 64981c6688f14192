// The whole terminal for one text that is renewed, by ncurses: what was there before comes back in
// the end.
#pragma once

#include <cstddef>
#include <string>

namespace stormproof::cli {

/// Takes the terminal behind standard output until it is destroyed. There must be one.
class FullScreen {
 public:
  FullScreen();
  ~FullScreen();
  FullScreen(const FullScreen&) = delete;
  FullScreen& operator=(const FullScreen&) = delete;

  [[nodiscard]] static std::size_t columns();
  /// Shows the lines that fit, from the top; `footer` stays on the last.
  static void show(const std::string& text, const std::string& footer);
  /// The key that was pressed since the last call; 0 if none was.
  [[nodiscard]] static int key();
};

}  // namespace stormproof::cli
