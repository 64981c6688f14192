// `stormproof doctor CAPTURE…`, or `--interface NAME`: records or reads captures, and says what is
// wrong with the discovery in them.
#include <filesystem>

#include <fmt/core.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/durations.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/health.hpp"
#include "checker/cli/on_captures.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/cli/streams.hpp"
#include "checker/evidence/capture/recording.hpp"
#include "checker/evidence/doctor/doctor.hpp"
#include "model/config/tree/quantities.hpp"

namespace stormproof::cli {

namespace {

struct DoctorArguments {
  doctor::Request request;
  std::string interface;
  std::string duration = "60s";
  std::string recorded = "stormproof-doctor.pcap";
  std::string until;
  std::vector<std::string> limits;
  OutputFile xml;
  bool no_advice = false;
};

/// Records into a file that `doctor` then reads as any other; why that failed, or nothing.
std::optional<Complaint> record(DoctorArguments& arguments, Session& session) {
  constexpr model::Nanoseconds longest{86'400'000'000'000};
  const auto duration = parse_duration("--for", arguments.duration, longest);
  if (!duration) return Complaint{duration.error()};
  const auto recorded = capture::record(
      {arguments.interface, *duration, arguments.recorded}, [&](std::uint64_t packets) {
        return session.proceed(
            [&] { return fmt::format("recording {}: {} packets", arguments.interface, packets); });
      });
  if (!recorded) return Complaint{recorded.error()};
  if (*recorded == 0) {
    return Complaint{
        fmt::format("--interface {}: no UDP packet came within {}; is it the one that "
                    "the robots are on?",
                    arguments.interface, arguments.duration)};
  }
  arguments.request.files = {arguments.recorded};
  return std::nullopt;
}

/// `--limit` by `--limit`; the error of the first that is none.
std::optional<std::string> parse_limits(const std::vector<std::string>& texts,
                                        model::Limits& limits) {
  constexpr model::Nanoseconds longest{1'000'000'000'000};
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : text.substr(equals + 1);
    if (name == "late") {
      const auto late = parse_duration("--limit late", value, longest);
      if (!late) return late.error();
      limits.late = *late;
    } else if (name == "needless") {
      const auto needless = model::config::parse_fraction(value);
      if (!needless) return fmt::format("--limit {}: {}", text, needless.error());
      limits.needless = model::Ratio{needless->numerator, needless->denominator};
    } else {
      return fmt::format("--limit {}: expected late=TIME or needless=RATIO, such as late=3s", text);
    }
  }
  return std::nullopt;
}

std::vector<report::NextStep> next_of(const doctor::Report& report,
                                      const doctor::Request& request) {
  std::vector<report::NextStep> next;
  if (report.basis) {
    next.push_back({on_captures({"validate"}, request.files,
                                {"--dds", report.basis->dds, "--wireless", report.basis->wireless}),
                    "the model beside these captures, figure by figure"});
  }
  next.push_back({on_captures({"capture", "summarize"}, request.files),
                  "every count, and the growth over time"});
  return next;
}

Outcome run(DoctorArguments& arguments, Session& session) {
  doctor::Request& request = arguments.request;
  if (request.files.empty() == arguments.interface.empty()) {
    return Complaint{"expected either captures to read, or --interface NAME to record from"};
  }
  if (auto error = parse_limits(arguments.limits, request.limits)) return Complaint{*error};
  if (!arguments.interface.empty()) {
    if (auto error = record(arguments, session)) return *std::move(error);
  }
  const auto conversation = capture::read_conversation(request.files, session.on_packets());
  if (!conversation) return conversation.error();
  const auto until = parse_until(arguments.until, conversation->first_ns);
  if (!until) return Complaint{until.error()};
  request.until_ns = *until;
  request.advise = !arguments.no_advice;
  request.on_progress = session.on_steps();
  const auto report = doctor::diagnose(*conversation, request);
  if (!report) return report.error();
  Answer answer{document_of(*report, request), to_json(*report)};
  const bool interrupted = Session::interrupted();
  answer.document.exit_code = interrupted ? inconclusive : exit_code_of(report->health);
  answer.document.complete = !interrupted;
  answer.document.next = next_of(*report, request);
  if (!arguments.interface.empty()) {
    answer.notes.push_back("stormproof: the recording is " + arguments.recorded);
  }
  if (arguments.xml.wanted()) {
    const doctor::Advice* best = !report->advice.empty()   ? &report->advice.front()
                                 : report->without_lookups ? &*report->without_lookups
                                                           : nullptr;
    if (best == nullptr) {
      answer.notes.push_back(
          fmt::format("stormproof: {} is not written: there is no advice", arguments.xml.path()));
      arguments.xml.discard();
    } else {
      arguments.xml.stream() << best->xml;
    }
  }
  return answer;
}

void declare(Options& options, DoctorArguments& arguments) {
  doctor::Request& request = arguments.request;
  options.captures(request.files, false);
  const Option interface =
      options.text("--interface", arguments.interface,
                   "Record from this network interface first; nothing is ever sent", "NAME");
  options.text("--for", arguments.duration, "Record so long (default 60s)", "DURATION")
      .needs(interface);
  options
      .written("--recording", arguments.recorded,
               "Where the recording is kept (default stormproof-doctor.pcap)", "FILE.pcap")
      .needs(interface);
  options.until(arguments.until, "Look at events until this instant");
  options.texts("--limit", arguments.limits,
                "What a storm is (repeatable): late=1s from the last start on, needless=1 times "
                "what everything sent once takes",
                "NAME=VALUE");
  options.text("--dds", request.dds,
               "DDS profile to predict with (default: the one that explains the capture)",
               "PROFILE");
  options.text("--wireless", request.wireless,
               "Wireless profile to predict with (default: the shipped one that comes nearest)",
               "PROFILE");
  options.flag("--no-advice", arguments.no_advice, "Do not look for settings that help");
  options
      .number("--budget", request.budget, "Runs of the model that look for them (default 100)", "N")
      .within(50, 1'000'000);
  options.output("--xml", arguments.xml, "Write the best setting as the vendor's file");
  options.jobs(request.threads);
}

}  // namespace

void declare_doctor(Frame& frame) {
  frame.add<DoctorArguments>(
      {"doctor",
       "What is wrong with the discovery in a capture, why, and what to change",
       "Exit code: 0 healthy, 1 a storm, incomplete or unmatched, 3 it cannot be told, or\n"
       "interrupted; 2 bad input.",
       Formats::pages,
       {doctor::json_schema}},
      declare, run);
}

}  // namespace stormproof::cli
