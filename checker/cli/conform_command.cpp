// Reads the captures and the profile, has them held against each other, and writes the reports.
#include "checker/cli/conform_command.hpp"

#include <memory>

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "checker/cli/complain.hpp"
#include "checker/cli/exit_code.hpp"
#include "checker/cli/options.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/cli/report_files.hpp"
#include "checker/cli/run_monitor.hpp"
#include "checker/cli/until_instant.hpp"
#include "checker/evidence/conform/report/report.hpp"
#include "checker/presentation/document/render.hpp"
#include "checker/presentation/json/dumped.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "model/config/scenario_file.hpp"
#include "model/config/tree/quantities.hpp"

namespace stormproof::cli {

namespace {

using conform::Bounds;
using model::config::Result;

struct ConformArguments {
  std::vector<std::string> files;
  std::string dds;
  std::vector<std::string> overrides;  ///< key.path=value, without "dds."
  std::string until;                   ///< empty: everything
  std::string delay;                   ///< LO..HI; empty: the default, as the next three
  std::string send_lag;
  std::string lateness;
  std::string clock_error;
  bool no_loss = false;
  report::Format format = report::Format::text;
  std::vector<std::string> reports;
  std::string svg_file;
  std::string assignment_file;
  std::optional<bool> progress;
};

/// A bound in ns; the error names the option.
Result<std::int64_t, std::string> parse_bound(const char* option, const std::string& text) {
  constexpr std::int64_t most = 86'400'000'000'000;
  constexpr const char* expected = "expected a duration from 0 to 86400s, such as 20ms";
  const auto duration = model::config::parse_duration(text);
  if (!duration) return fmt::format("{}: {}; {}", option, duration.error(), expected);
  if (duration->count() > most)
    return fmt::format("{}: '{}' is too long; {}", option, text, expected);
  return duration->count();
}

/// Reads LO..HI into the two bounds of the delay; what is wrong, or nothing.
std::optional<std::string> parse_delay(const std::string& text, Bounds& bounds) {
  constexpr std::string_view separator = "..";
  const std::size_t at = text.find(separator);
  if (at == std::string::npos) {
    return fmt::format("--delay: '{}' is no range; expected LO..HI, such as 0..60s", text);
  }
  const auto least = parse_bound("--delay", text.substr(0, at));
  if (!least) return least.error();
  const auto most = parse_bound("--delay", text.substr(at + separator.size()));
  if (!most) return most.error();
  if (*least > *most) {
    return fmt::format("--delay: '{}' is empty; expected LO..HI with LO at most HI", text);
  }
  bounds.least_delay_ns = *least;
  bounds.most_delay_ns = *most;
  return std::nullopt;
}

Result<Bounds, std::string> parse_bounds(const ConformArguments& arguments) {
  Bounds bounds;
  if (!arguments.delay.empty()) {
    if (auto error = parse_delay(arguments.delay, bounds)) return *error;
  }
  const auto read = [](const char* option, const std::string& text,
                       std::int64_t& bound) -> std::optional<std::string> {
    if (text.empty()) return std::nullopt;
    const auto value = parse_bound(option, text);
    if (!value) return value.error();
    bound = *value;
    return std::nullopt;
  };
  auto error = read("--send-lag", arguments.send_lag, bounds.most_send_lag_ns);
  if (!error) error = read("--lateness", arguments.lateness, bounds.most_lateness_ns);
  if (!error) error = read("--clock-error", arguments.clock_error, bounds.clock_error_ns);
  if (error) return *error;
  bounds.may_lose = !arguments.no_loss;
  return bounds;
}

/// The command that gives the same verdict.
std::string command_line(const ConformArguments& arguments) {
  std::string command = "stormproof conform";
  for (const std::string& file : arguments.files) command += " " + report::shell_word(file);
  const auto add = [&command](const char* option, const std::string& value) {
    if (!value.empty()) command += fmt::format(" {} {}", option, report::shell_word(value));
  };
  add("--dds", arguments.dds);
  for (const std::string& change : arguments.overrides) add("--set", change);
  add("--until", arguments.until);
  add("--delay", arguments.delay);
  add("--send-lag", arguments.send_lag);
  add("--lateness", arguments.lateness);
  add("--clock-error", arguments.clock_error);
  return command + (arguments.no_loss ? " --no-loss" : "");
}

/// The profile as reports name it.
std::string profile_name(const ConformArguments& arguments) {
  std::string name = arguments.dds;
  for (std::size_t k = 0; k < arguments.overrides.size(); ++k) {
    name += (k == 0 ? " with " : ", ") + arguments.overrides[k];
  }
  return name;
}

int exit_code(conform::Verdict verdict) {
  switch (verdict) {
    case conform::Verdict::conforms:
      return established;
    case conform::Verdict::does_not_conform:
      return not_conformant;
    case conform::Verdict::inconclusive:
      break;
  }
  return inconclusive;
}

std::string render(report::Format format, const conform::Report& report,
                   const report::Document& document) {
  switch (format) {
    case report::Format::json:
      return report::dumped(to_json(report));
    case report::Format::markdown:
      return to_markdown(document);
    case report::Format::html:
      return to_html(document);
    case report::Format::junit:
      return to_junit(document);
    case report::Format::sarif:
      return report::dumped(to_sarif(document));
    case report::Format::text:
      break;
  }
  return to_text(document);
}

Result<capture::Conversation> read(const ConformArguments& arguments) {
  StatusLine line{arguments.progress.value_or(isatty(STDERR_FILENO) != 0)};
  return capture::read_conversation(arguments.files, [&line](std::uint64_t packets) {
    if (line.due()) line.show(fmt::format("{} packets", report::grouped(packets)));
    return !InterruptGuard::interrupted();
  });
}

/// The files beside the report. What could not be written, or nothing.
std::optional<std::string> write_files(const ConformArguments& arguments,
                                       const conform::Report& report, OutputFile& svg,
                                       OutputFile& assignment) {
  if (assignment.wanted()) {
    assignment.stream() << conform::assignment_lines(report);
    if (auto error = assignment.commit()) return error;
  }
  if (!svg.wanted()) return std::nullopt;
  if (report.result.unexplained.empty()) {
    fmt::print(stderr, "stormproof: {} is not written: there is no unexplained event to draw\n",
               arguments.svg_file);
    return std::nullopt;
  }
  svg.stream() << to_svg(report);
  return svg.commit();
}

int run_conform(const ConformArguments& arguments) {
  const auto bounds = parse_bounds(arguments);
  if (!bounds) return complain(bounds.error());
  const auto reports = parse_report_files(arguments.reports);
  if (!reports) return complain(to_string(reports.error()));
  const auto dds = model::config::read_dds_profile(arguments.dds, arguments.overrides,
                                                   model::config::SpecPath::standard());
  if (!dds) return complain(to_string(dds.error()));
  OutputFile svg{arguments.svg_file};
  OutputFile assignment{arguments.assignment_file};
  for (const OutputFile* file : {&svg, &assignment}) {
    if (const auto error = file->open_error()) return complain(*error);
  }
  const InterruptGuard guard;
  const auto conversation = read(arguments);
  if (!conversation) return complain(to_string(conversation.error()));
  const auto until = parse_until(arguments.until, conversation->first_ns);
  if (!until) return complain(until.error());
  const auto result = [&] {
    StatusLine line{arguments.progress.value_or(isatty(STDERR_FILENO) != 0)};
    const auto on_progress = [&line](std::size_t done, std::size_t all) {
      if (line.due()) line.show(fmt::format("relation {} of {}", done, all));
      return !InterruptGuard::interrupted();
    };
    return conform::conform({*conversation, *until, *dds, *bounds, on_progress});
  }();
  if (!result) return complain(to_string(result.error()));
  const int code = exit_code(result->verdict);
  const conform::Report report{*conversation, *result, *dds, profile_name(arguments), *until};
  report::Document document = document_of(report);
  document.command = command_line(arguments);
  document.exit_code = code;
  fmt::print("{}", render(arguments.format, report, document));
  if (const auto error = write_files(arguments, report, svg, assignment)) return complain(*error);
  const auto failure = write_report_files(
      *reports, [&](report::Format format) { return render(format, report, document); });
  if (failure) return complain(*failure);
  return code;
}

void add_bounds(CLI::App& command, ConformArguments& arguments) {
  const Bounds defaults;
  const auto printed = [](std::int64_t bound) {
    return bound == 0 ? "0" : model::config::print_duration(model::Nanoseconds{bound});
  };
  const auto with_default = [](const char* help, const std::string& bound) {
    return fmt::format("{} (default: {})", help, bound);
  };
  command
      .add_option("--delay", arguments.delay,
                  with_default("From the capture of a datagram to its reception",
                               fmt::format("{}..{}", printed(defaults.least_delay_ns),
                                           printed(defaults.most_delay_ns))))
      ->type_name("LO..HI");
  command
      .add_option("--send-lag", arguments.send_lag,
                  with_default("From a rule's sending to the capture of the datagram, at most",
                               printed(defaults.most_send_lag_ns)))
      ->type_name("DURATION");
  command
      .add_option(
          "--lateness", arguments.lateness,
          with_default("How late a timer may act, at most", printed(defaults.most_lateness_ns)))
      ->type_name("DURATION");
  command
      .add_option("--clock-error", arguments.clock_error,
                  with_default("How far the clocks of the captures may be apart",
                               printed(defaults.clock_error_ns)))
      ->type_name("DURATION");
  command.add_flag("--no-loss", arguments.no_loss, "Every captured datagram arrives");
}

}  // namespace

void declare_conform(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<ConformArguments>();
  CLI::App* command = app.add_subcommand(
      "conform", "Whether captures of real discovery are a behaviour of a DDS profile");
  command
      ->add_option("captures", arguments->files,
                   "pcap or pcapng, plain, .xz or .gz; several of one run are merged")
      ->required()
      ->type_name("FILE");
  command->add_option("--dds", arguments->dds, "DDS profile: name, YAML file or vendor XML file")
      ->required()
      ->type_name("PROFILE");
  add_repeatable(*command, "--set", arguments->overrides,
                 "Override a key of the profile: key.path=value (repeatable)")
      ->type_name("KEY=VALUE");
  command
      ->add_option("--until", arguments->until,
                   "Look at events until this instant: a duration after the first packet, or ns "
                   "since 1970")
      ->type_name("INSTANT");
  add_bounds(*command, *arguments);
  add_format(*command, arguments->format);
  add_report_files(*command, arguments->reports);
  command
      ->add_option("--svg", arguments->svg_file,
                   "Draw what surrounds the first unexplained event, if there is one")
      ->type_name("FILE");
  command
      ->add_option("--assignment", arguments->assignment_file,
                   "Write the receptions, losses and timers that explain the capture (JSON Lines)")
      ->type_name("FILE");
  add_progress(*command, arguments->progress);
  command->footer(
      "Exit code: 0 conforms within the bounds, 4 does not, 3 inconclusive or interrupted,\n"
      "2 bad input.");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return run_conform(*arguments); }; });
}

}  // namespace stormproof::cli
