// `stormproof watch --interface NAME`: what `doctor` says of a capture without a model, once a
// second while it is made. The newest packets stay in a ring of two files.
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/durations.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/full_screen.hpp"
#include "checker/cli/health.hpp"
#include "checker/cli/on_captures.hpp"
#include "checker/evidence/capture/recording.hpp"
#include "checker/evidence/doctor/doctor.hpp"
#include "checker/presentation/document/render.hpp"

namespace stormproof::cli {

namespace {

struct WatchArguments {
  std::string interface;
  std::string duration = "24h";
  std::string ring = "stormproof-watch.pcap";
  std::size_t ring_megabytes = 32;
};

std::vector<std::string> files_of(const capture::Recording& recording) {
  std::vector<std::string> files;
  if (std::filesystem::exists(recording.older())) files.push_back(recording.older());
  files.push_back(recording.path);
  return files;
}

/// What there is to see now; packets that are no RTPS are no reason to stop.
std::string glance(const capture::Recording& recording, std::size_t columns) {
  const auto conversation = capture::read_conversation(files_of(recording));
  if (!conversation) return "No RTPS message yet.";
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const std::int64_t now_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
  return to_text(doctor::glance_at(doctor::examine(*conversation), now_ns), {columns});
}

/// Whether to go on recording: renews the screen once a second, and looks for `q`.
class Watch {
 public:
  explicit Watch(const capture::Recording& recording) : recording_{recording} {
    if (isatty(STDOUT_FILENO) != 0) screen_.emplace();
  }

  bool operator()(std::uint64_t packets) {
    if (Session::interrupted()) return false;
    if (!screen_) return true;
    if (FullScreen::key() == 'q') return false;
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return true;
    next_ = now + std::chrono::seconds{1};
    FullScreen::show(glance(recording_, FullScreen::columns()),
                     fmt::format("{}: {} packets in {}   q quits", recording_.interface, packets,
                                 recording_.path));
    return true;
  }

 private:
  const capture::Recording& recording_;
  std::optional<FullScreen> screen_;
  std::chrono::steady_clock::time_point next_{};
};

Outcome run(WatchArguments& arguments, Session& session) {
  constexpr model::Nanoseconds longest{30 * 86'400'000'000'000};
  const auto duration = parse_duration("--for", arguments.duration, longest);
  if (!duration) return Complaint{duration.error()};
  const capture::Recording recording{arguments.interface, *duration, arguments.ring,
                                     arguments.ring_megabytes * 1'000'000};
  std::error_code ignored;
  std::filesystem::remove(recording.older(), ignored);
  const auto recorded = [&] {
    Watch watch{recording};
    return capture::record(recording, [&](std::uint64_t packets) { return watch(packets); });
  }();
  if (!recorded) return recorded.error();
  const std::vector<std::string> files = files_of(recording);
  const auto conversation = capture::read_conversation(files, session.on_packets());
  const capture::Conversation nothing;
  doctor::Report report = doctor::examine(conversation ? *conversation : nothing);
  if (!conversation) report.why_unknown = to_string(conversation.error());
  doctor::Request request;
  request.files = files;
  Answer answer{document_of(report, request), to_json(report)};
  answer.document.exit_code = exit_code_of(report.health);
  answer.document.next = {
      {on_captures({"doctor"}, files), "which presets behave like that, and which settings help"}};
  return answer;
}

void declare(Options& options, WatchArguments& arguments) {
  options
      .text("--interface", arguments.interface, "The network interface; nothing is ever sent",
            "NAME")
      .required();
  options.text("--for", arguments.duration, "Watch so long (default: until q or Ctrl-C)",
               "DURATION");
  options.written("--ring", arguments.ring,
                  "Where the newest packets are kept (default stormproof-watch.pcap, and the same "
                  "with .1)",
                  "FILE.pcap");
  options
      .number("--ring-size", arguments.ring_megabytes, "Megabytes that are kept (default 32)", "N")
      .within(1, 10'000);
}

}  // namespace

void declare_watch(Frame& frame) {
  frame.add<WatchArguments>(
      {"watch",
       "The counts of discovery on an interface, once a second; q leaves",
       "Exit code: 0 healthy, 1 a storm, incomplete or unmatched, 3 it cannot be told;\n"
       "2 bad input.",
       Formats::pages,
       {doctor::json_schema}},
      declare, run);
}

}  // namespace stormproof::cli
