// Other programs that an engine asks: cvc5, SPIN, a C compiler. They get nothing to read; what they
// print is the answer.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace stormproof::process {

struct Program {
  std::vector<std::string> arguments;  ///< the first is the program, looked up in PATH
  std::filesystem::path folder{};      ///< where it runs; empty: here
  bool errors = false;                 ///< standard error belongs to the output, too
  std::chrono::milliseconds limit = std::chrono::hours{24 * 365};  ///< it is stopped then
  std::function<bool()> stop{};  ///< asked now and then: whether to stop it; empty: never
};

struct Run {
  std::string output;  ///< at most 16 MB; a program that prints more is stopped
  std::string
      failure;  ///< why there is no exit status: "cannot be started: …"; empty: there is one
  int status = 0;

  [[nodiscard]] bool succeeded() const { return failure.empty() && status == 0; }
};

/// Starts the program and waits for its end. Ctrl-C at the terminal is not for it, but for us: it
/// is in a process group of its own.
[[nodiscard]] Run run(const Program& program);

}  // namespace stormproof::process
