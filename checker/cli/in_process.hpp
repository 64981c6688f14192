// A command for a program that this one is a part of (the Python module): the same parser, the same
// work, and what the command line would print, as a value.
#pragma once

#include <string>
#include <vector>

namespace stormproof::cli {

struct Reply {
  int exit_code = 0;
  std::string printed;  ///< on standard output: with `--format json` one document
  std::string said;     ///< on standard error: notes, and why there is no answer
};

/// What the command line would do with these words behind the program. Blocks until that is done,
/// or `interrupt_command` is called; one command at a time, others wait. Signals stay with the
/// threads of the caller. Throws what nobody expected, and std::bad_alloc.
[[nodiscard]] Reply reply_to(std::vector<std::string> words);

/// Has the command that runs stop soon, with what is known by then.
void interrupt_command();

}  // namespace stormproof::cli
