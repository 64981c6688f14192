// `stormproof help COMMAND` and `stormproof completion bash`: what is known of the commands, from
// the parser itself.
#include <fmt/core.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/frame.hpp"

namespace stormproof::cli {

void declare_help(Frame& frame) {
  const auto words = std::make_shared<std::vector<std::string>>();
  frame.add(
      {.name = "help",
       .help = "Explain a command, with examples",
       .exit_codes = "Exit code: 0, or 2 for what is no command.",
       .formats = Formats::none,
       .takes_long = false},
      [words](Options& options) {
        options.texts("command", *words, "Such as simulate, or profile show; without it, all",
                      "COMMAND");
      },
      [words, &frame](Session& /*session*/) -> Outcome {
        if (auto complaint = frame.refuse(*words)) return *std::move(complaint);
        fmt::print("{}", frame.help_of(*words));
        return established;
      });
  frame.group("completion", "Print what completes commands in a shell: bash");
  frame.add(
      {.name = "completion bash",
       .help = "Print what completes commands and options in bash",
       .exit_codes = "Exit code: 0.",
       .formats = Formats::none,
       .takes_long = false},
      [](Options& /*none*/) {},
      [&frame](Session& /*session*/) -> Outcome {
        fmt::print("{}", frame.bash_completion());
        return established;
      });
}

}  // namespace stormproof::cli
