// Reads the captures, has them predicted and compared, prints the report and writes the plot.
#include "checker/cli/validate_command.hpp"

#include <charconv>
#include <limits>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "checker/cli/complain.hpp"
#include "checker/cli/exit_code.hpp"
#include "checker/cli/options.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/cli/run_monitor.hpp"
#include "checker/cli/until_instant.hpp"
#include "checker/evidence/capture/events.hpp"
#include "checker/evidence/validate/validate.hpp"
#include "checker/presentation/document/render.hpp"
#include "checker/presentation/json/dumped.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "model/config/knobs/effective.hpp"
#include "model/config/tree/quantities.hpp"

namespace stormproof::cli {

namespace {

using model::Nanoseconds;
using TimeRange = std::pair<Nanoseconds, Nanoseconds>;

struct ValidateArguments {
  std::vector<std::string> files;
  validate::Request request;
  std::string until, endpoints_done, loss;  ///< as written; empty: not given
  std::string svg_file;
  std::string scenario_file;
  bool json = false;
  std::optional<bool> progress;
};

template <class T>
using Parsed = model::config::Result<T, std::string>;

Parsed<std::optional<TimeRange>> parse_range(const std::string& text) {
  if (text.empty()) return std::optional<TimeRange>{};
  const std::size_t dots = text.find("..");
  if (dots != std::string::npos) {
    const auto low = model::config::parse_duration(std::string_view{text}.substr(0, dots));
    const auto high = model::config::parse_duration(std::string_view{text}.substr(dots + 2));
    const Nanoseconds longest{1'000'000'000'000'000};
    if (low && high && *low >= Nanoseconds{0} && *low <= *high && *high <= longest) {
      return std::optional{TimeRange{*low, *high}};
    }
  }
  return fmt::format(
      "--endpoints-done '{}': expected two durations in ascending order, such as 20ms..80ms", text);
}

/// "5%" or "0.05".
Parsed<double> parse_loss(const std::string& text) {
  if (text.empty()) return 0.0;
  const bool percent = text.ends_with('%');
  const std::size_t digits = text.size() - (percent ? 1 : 0);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + digits, value);
  if (percent) value /= 100;
  if (error == std::errc{} && end == text.data() + digits && value >= 0 && value < 1) return value;
  return fmt::format("--loss '{}': expected a probability below 1, such as 5% or 0.05", text);
}

/// The command line that gives the same report.
std::string command_line(const ValidateArguments& a) {
  std::string command = "stormproof validate";
  for (const std::string& file : a.files) command += " " + report::shell_word(file);
  const auto add = [&command](const char* option, const std::string& value) {
    if (!value.empty()) command += fmt::format(" {} {}", option, report::shell_word(value));
  };
  add("--dds", a.request.dds);
  add("--wireless", a.request.wireless);
  for (const std::string& set : a.request.overrides) add("--set", set);
  add("--until", a.until);
  add("--endpoints-done", a.endpoints_done);
  add("--loss", a.loss);
  if (a.request.within) add("--within", fmt::format("{}", *a.request.within));
  return command + fmt::format(" --samples {} --seed {}", a.request.sampling.samples,
                               a.request.sampling.first_seed);
}

/// Options that are texts, as values of the request; what is wrong with one, or nothing.
std::optional<std::string> complete(validate::Request& request, const ValidateArguments& arguments,
                                    std::int64_t first_ns) {
  const auto until = parse_until(arguments.until, first_ns);
  if (!until) return until.error();
  const auto range = parse_range(arguments.endpoints_done);
  if (!range) return range.error();
  const auto loss = parse_loss(arguments.loss);
  if (!loss) return loss.error();
  if (!arguments.until.empty()) request.until_ns = *until;
  request.endpoints_done = *range;
  request.sampling.loss = *loss;
  return std::nullopt;
}

int exit_code(const validate::Report& report) {
  if (report.interrupted()) return inconclusive;
  if (report.agreement == validate::Agreement::beyond) return violated;
  const bool decided = report.agreement != validate::Agreement::undecided;
  return report.observation.complete && decided ? established : inconclusive;
}

int print(const ValidateArguments& arguments, const validate::Report& report, OutputFile& svg,
          OutputFile& scenario) {
  const validate::Heading heading{arguments.files, command_line(arguments)};
  fmt::print("{}", arguments.json ? report::dumped(to_json(report, heading))
                                  : to_text(document_of(report, heading)));
  if (svg.wanted()) svg.stream() << to_svg(report);
  if (const auto error = svg.commit()) return complain(*error);
  if (scenario.wanted()) scenario.stream() << model::config::effective_yaml(report.scenario);
  if (const auto error = scenario.commit()) return complain(*error);
  if (report.interrupted()) {
    fmt::print(stderr, "stormproof: interrupted; {} of {} runs finished\n", report.runs,
               report.wanted);
  }
  return exit_code(report);
}

int validate_captures(const ValidateArguments& arguments) {
  OutputFile svg{arguments.svg_file};
  if (const auto error = svg.open_error()) return complain(*error);
  OutputFile scenario{arguments.scenario_file};
  if (const auto error = scenario.open_error()) return complain(*error);
  validate::Request request = arguments.request;
  // What needs no capture is refused before one is read.
  constexpr std::int64_t any_first = 0;
  if (const auto error = complete(request, arguments, any_first)) return complain(*error);
  const InterruptGuard guard;
  const bool shows = arguments.progress.value_or(isatty(STDERR_FILENO) != 0);
  const auto conversation = [&] {
    StatusLine line{shows};
    return capture::read_conversation(arguments.files, [&line](std::uint64_t packets) {
      if (line.due()) line.show(fmt::format("{} packets", report::grouped(packets)));
      return !InterruptGuard::interrupted();
    });
  }();
  if (!conversation) return complain(to_string(conversation.error()));
  if (InterruptGuard::interrupted()) {
    fmt::print(stderr, "stormproof: interrupted while reading; nothing was compared\n");
    return inconclusive;
  }
  if (const auto error = complete(request, arguments, conversation->first_ns)) {
    return complain(*error);
  }
  const auto report = [&] {
    StatusLine line{shows};
    request.sampling.on_progress = [&line](std::size_t finished, std::size_t all) {
      if (line.due()) line.show(fmt::format("{} of {} runs", finished, all));
      return !InterruptGuard::interrupted();
    };
    return validate::validate(*conversation, request);
  }();
  if (!report) return complain(to_string(report.error()));
  return print(arguments, *report, svg, scenario);
}

void declare_model(CLI::App& command, ValidateArguments& arguments) {
  validate::Request& request = arguments.request;
  command.add_option("--dds", request.dds, "DDS profile to predict with")
      ->required()
      ->type_name("PROFILE");
  command.add_option("--wireless", request.wireless, "Wireless profile")
      ->required()
      ->type_name("PROFILE");
  add_repeatable(command, "--set", request.overrides,
                 "Override a key of the scenario: key.path=value (repeatable)")
      ->type_name("KEY=VALUE");
  command
      .add_option("--endpoints-done", arguments.endpoints_done,
                  "When participants have all endpoints, instead of what the capture proves: "
                  "durations after the first announcement")
      ->type_name("LOW..HIGH");
  command
      .add_option("--loss", arguments.loss,
                  "Each packet is lost with this probability, such as 5% or 0.05 (default 0)")
      ->type_name("RATIO");
  command.add_option("--samples", request.sampling.samples, "Runs of the model (default 24)")
      ->check(CLI::Range(1, 100'000))
      ->type_name("N");
  command.add_option("--seed", request.sampling.first_seed, "Seed of the first run (default 0)")
      ->type_name("S");
  command
      .add_option("--jobs", request.sampling.threads, "Runs at the same time (default: all cores)")
      ->check(CLI::Range(1, 4'096))
      ->type_name("N");
}

}  // namespace

void declare_validate(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<ValidateArguments>();
  CLI::App* command = app.add_subcommand(
      "validate", "Predict the discovery in a capture: model beside observation");
  command
      ->add_option("captures", arguments->files,
                   "pcap or pcapng, plain, .xz or .gz; several of one run are merged")
      ->required()
      ->type_name("FILE");
  declare_model(*command, *arguments);
  command
      ->add_option("--until", arguments->until,
                   "When discovery was complete: a duration after the first packet, or ns since "
                   "1970 (default: the last initial DATA)")
      ->type_name("INSTANT");
  command
      ->add_option("--within", arguments->request.within,
                   "Exit code 1 if completion or messages are off by more than this factor")
      ->check(CLI::Range(1.0, 1e6))
      ->type_name("RATIO");
  command->add_option("--svg", arguments->svg_file, "Write a plot of the counts over time")
      ->type_name("FILE");
  command
      ->add_option("--scenario", arguments->scenario_file,
                   "Write the scenario of the first run, as simulate reads it")
      ->type_name("FILE");
  add_format(*command, arguments->json);
  add_progress(*command, arguments->progress);
  command->footer(
      "Exit code: 0 the comparison was made, 1 it is beyond --within, 3 the capture is "
      "incomplete,\n"
      "or interrupted; 2 bad input.");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return validate_captures(*arguments); }; });
}

}  // namespace stormproof::cli
