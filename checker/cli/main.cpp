// The program: runs a command, turns what nobody expected into exit code 70.
#include <exception>
#include <new>

#include <fmt/core.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/exit_code.hpp"
#include "checker/cli/frame.hpp"

int main(int argc, char** argv) {
  namespace cli = stormproof::cli;
  try {
    cli::Frame frame;
    cli::declare_commands(frame);
    return frame.run(argc, argv);
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "stormproof: out of memory; try a smaller deployment or a shorter limit\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "stormproof: internal error: {}\n", error.what());
  }
  return cli::internal_error;
}
