// The program: runs a command, turns what nobody expected into exit code 70.
#include <exception>
#include <new>
#include <string>

#include "checker/cli/commands.hpp"
#include "checker/cli/complain.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/memory_limit.hpp"
#include "checker/cli/streams.hpp"
#include "checker/presentation/text/command_line.hpp"
#include "model/keep_memory.hpp"

namespace {

namespace cli = stormproof::cli;

int run(int argc, char** argv) {
  try {
    cli::Frame frame;
    cli::declare_commands(frame);
    return frame.run(argc, argv);
  } catch (const std::bad_alloc&) {
    cli::complain(cli::needs_more_memory());
    return cli::inconclusive;
  } catch (const std::exception& error) {
    cli::complain(std::string{"internal error: "} + error.what());
  }
  return cli::internal_error;
}

}  // namespace

int main(int argc, char** argv) {
  stormproof::model::keep_memory();
  cli::prepare_streams();
  stormproof::report::set_program(argc > 0 ? argv[0] : "");
  const int code = run(argc, argv);
  const auto lost = cli::output_lost();
  if (!lost) return code;
  return lost->empty() ? cli::bad_input : cli::complain(*lost);
}
