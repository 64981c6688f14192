// `stormproof capture annotate FILE -o FILE.pcapng`: the capture with a comment on each packet that
// was sent for one of the doctor's causes, for Wireshark.
#include <ostream>

#include <fmt/core.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/cli/streams.hpp"
#include "checker/evidence/capture/capture_file.hpp"
#include "checker/evidence/capture/write/pcapng_writer.hpp"
#include "checker/evidence/doctor/annotations.hpp"
#include "checker/presentation/text/numbers.hpp"

namespace stormproof::cli {

namespace {

struct AnnotateArguments {
  std::string file;
  OutputFile output;
};

Outcome run(AnnotateArguments& arguments, Session& session) {
  if (arguments.file == "-") return Complaint{"-: expected a file, because it is read twice"};
  const std::string files[] = {arguments.file};
  const auto conversation = capture::read_conversation(files, session.on_packets());
  if (!conversation) return conversation.error();
  const doctor::Annotations comments =
      doctor::annotations(*conversation, capture::count(*conversation, INT64_MAX));
  auto packets = capture::CaptureFile::open(arguments.file);
  if (!packets) return packets.error();
  std::ostream& out = arguments.output.stream();
  capture::write::PcapngWriter writer{[&out](capture::Bytes bytes) {
                                        out.write(reinterpret_cast<const char*>(bytes.data()),
                                                  static_cast<std::streamsize>(bytes.size()));
                                      },
                                      packets->link_type()};
  while (const auto packet = packets->next()) {
    const auto comment = comments.find(packet->number);
    writer.packet(*packet, comment == comments.end() ? std::string{} : comment->second);
  }
  say(fmt::format("stormproof: {} of {} packets have a comment; next: wireshark -C stormproof {}",
                  report::grouped(comments.size()),
                  report::grouped(conversation->captures.front().packets),
                  arguments.output.path()));
  return Session::interrupted() ? inconclusive : established;
}

void declare(Options& options, AnnotateArguments& arguments) {
  options.text("capture", arguments.file, "pcap or pcapng, plain, .xz or .gz", "FILE").required();
  options
      .output("-o,--output", arguments.output, "Where the annotated capture is written, as pcapng")
      .required();
}

}  // namespace

void declare_annotate(Frame& frame) {
  frame.add<AnnotateArguments>(
      {.name = "capture annotate",
       .help = "A capture with comments for Wireshark: which packets were sent in vain, and why",
       .exit_codes = "Exit code: 0, 2 bad input, 3 interrupted.",
       .formats = Formats::none,
       .takes_long = false},
      declare, run);
}

}  // namespace stormproof::cli
