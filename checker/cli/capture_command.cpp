// `stormproof capture summarize FILE…`: what a capture of real discovery holds, counted as the
// paper counts.
#include "checker/cli/commands.hpp"
#include "checker/cli/durations.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/on_captures.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/evidence/capture/counting.hpp"
#include "checker/evidence/capture/events.hpp"
#include "checker/evidence/capture/summary.hpp"

namespace stormproof::cli {

namespace {

struct CaptureArguments {
  std::vector<std::string> files;
  std::string until;  ///< empty: everything counts
  OutputFile svg;
};

Outcome run(CaptureArguments& arguments, Session& session) {
  const auto conversation = capture::read_conversation(arguments.files, session.on_packets());
  if (!conversation) return conversation.error();
  const auto until = parse_until(arguments.until, conversation->first_ns);
  if (!until) return Complaint{until.error()};
  const capture::Counting counting = capture::count(*conversation, *until);
  const capture::Summary summary{*conversation, counting};
  Answer answer;
  answer.document = document_of(summary);
  answer.json = to_json(summary);
  answer.document.next = {
      {on_captures({"conform"}, arguments.files), "which library and version behaves so"}};
  if (arguments.svg.wanted()) arguments.svg.stream() << to_svg(summary);
  answer.document.exit_code = counting.last_initial_ns ? established : inconclusive;
  Session::note_interruption(answer.document);
  return answer;
}

void declare(Options& options, CaptureArguments& arguments) {
  options.captures(arguments.files);
  options.until(arguments.until, "Count until this instant");
  options.svg(arguments.svg, "Write a plot of the counts over time");
}

}  // namespace

void declare_capture(Frame& frame) {
  frame.group("capture", "Packet captures of real discovery");
  frame.add<CaptureArguments>(
      {"capture summarize",
       "Count the discovery messages, by class and over time, and recover the topology",
       "Exit code: 0 every required descriptor is in the capture, 3 some are missing,\n"
       "or interrupted; 2 bad input.",
       Formats::pages,
       {capture::json_schema}},
      declare, run);
}

}  // namespace stormproof::cli
