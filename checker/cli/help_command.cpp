// `stormproof help COMMAND`, `stormproof completion SHELL` and `stormproof man`: what is known of
// the commands, from the parser itself.
#include <fmt/core.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/streams.hpp"

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
        print(frame.help_of(*words));
        return established;
      });
  frame.group("completion", "Print what completes commands in a shell: bash, zsh, fish");
  for (const char* shell : {"bash", "zsh", "fish"}) {
    frame.add(
        {.name = fmt::format("completion {}", shell),
         .help = fmt::format("Print what completes commands and options in {}", shell),
         .exit_codes = "Exit code: 0.",
         .formats = Formats::none,
         .takes_long = false},
        [](Options& /*none*/) {},
        [shell, &frame](Session& /*session*/) -> Outcome {
          print(frame.completion(shell));
          return established;
        });
  }
  frame.add(
      {.name = "man",
       .help = "Print the manual page, in roff",
       .exit_codes = "Exit code: 0.",
       .formats = Formats::none,
       .takes_long = false},
      [](Options& /*none*/) {},
      [&frame](Session& /*session*/) -> Outcome {
        print(frame.man_page());
        return established;
      });
}

}  // namespace stormproof::cli
