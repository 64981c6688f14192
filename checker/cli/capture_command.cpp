// Reads the captures, counts until the given instant, prints the summary and writes the plot.
#include "checker/cli/capture_command.hpp"

#include <memory>

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "checker/cli/complain.hpp"
#include "checker/cli/exit_code.hpp"
#include "checker/cli/options.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/cli/run_monitor.hpp"
#include "checker/cli/until_instant.hpp"
#include "checker/evidence/capture/counting.hpp"
#include "checker/evidence/capture/events.hpp"
#include "checker/evidence/capture/summary.hpp"
#include "checker/presentation/document/render.hpp"
#include "checker/presentation/json/dumped.hpp"
#include "checker/presentation/text/numbers.hpp"

namespace stormproof::cli {

namespace {

struct CaptureArguments {
  std::vector<std::string> files;
  std::string until;  ///< empty: everything counts
  std::string svg_file;
  bool json = false;
  std::optional<bool> progress;
};

int summarize(const CaptureArguments& arguments) {
  OutputFile svg{arguments.svg_file};
  if (const auto error = svg.open_error()) return complain(*error);
  const InterruptGuard guard;
  const auto conversation = [&arguments] {
    StatusLine line{arguments.progress.value_or(isatty(STDERR_FILENO) != 0)};
    return capture::read_conversation(arguments.files, [&line](std::uint64_t packets) {
      if (line.due()) line.show(fmt::format("{} packets", report::grouped(packets)));
      return !InterruptGuard::interrupted();
    });
  }();
  if (!conversation) return complain(to_string(conversation.error()));
  const auto until = parse_until(arguments.until, conversation->first_ns);
  if (!until) return complain(until.error());
  const capture::Counting counting = capture::count(*conversation, *until);
  const capture::Summary summary{*conversation, counting};
  const bool is_interrupted = InterruptGuard::interrupted();
  fmt::print("{}",
             arguments.json ? report::dumped(to_json(summary)) : to_text(document_of(summary)));
  if (is_interrupted) {
    fmt::print(stderr, "stormproof: interrupted; this is what was read until then\n");
  }
  if (svg.wanted()) svg.stream() << to_svg(summary);
  if (const auto error = svg.commit()) return complain(*error);
  return is_interrupted || !counting.last_initial_ns ? inconclusive : established;
}

void declare_summarize(CLI::App& capture, Command& chosen) {
  const auto arguments = std::make_shared<CaptureArguments>();
  CLI::App* command = capture.add_subcommand(
      "summarize",
      "Count the discovery messages, by class and over time, and recover the topology");
  command
      ->add_option("captures", arguments->files,
                   "pcap or pcapng, plain, .xz or .gz; several of one run are merged")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--until", arguments->until,
                   "Count until this instant: a duration after the first packet, or ns since 1970")
      ->type_name("INSTANT");
  command->add_option("--svg", arguments->svg_file, "Write a plot of the counts over time")
      ->type_name("FILE");
  add_format(*command, arguments->json);
  add_progress(*command, arguments->progress);
  command->footer(
      "Exit code: 0 every required descriptor is in the capture, 3 some are missing,\n"
      "or interrupted; 2 bad input.");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return summarize(*arguments); }; });
}

}  // namespace

void declare_capture(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("capture", "Packet captures of real discovery");
  command->require_subcommand(1);
  declare_summarize(*command, chosen);
}

}  // namespace stormproof::cli
