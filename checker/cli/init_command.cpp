// `stormproof init`: asks what is not given, drafts the scenario, writes it.
#include <cstdlib>
#include <iostream>
#include <string_view>

#include <fmt/core.h>
#include <unistd.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/cli/streams.hpp"
#include "checker/evidence/init/environment.hpp"
#include "checker/presentation/text/command_line.hpp"

namespace stormproof::cli {

namespace {

struct InitArguments {
  init::System system;
  std::vector<std::string> captures;
  std::optional<std::size_t> hosts, participants, endpoints, types;
  std::string ros, rmw;  ///< empty: not given
  bool from_environment = false;
  OutputFile file;
};

/// The answer to a question, or the usual one.
std::string ask(const std::string& question, const std::string& usual) {
  mutter(fmt::format("{} [{}] ", question, usual));
  std::string line;
  std::getline(std::cin, line);
  return line.empty() ? usual : line;
}

/// A whole number of at least `least`, asked until it is one; the usual one at the end of the
/// input.
std::uint32_t ask_number(const std::string& question, std::uint32_t usual,
                         unsigned long least = 1) {
  for (;;) {
    const std::string line = ask(question, std::to_string(usual));
    char* end = nullptr;
    const unsigned long value = std::strtoul(line.c_str(), &end, 10);
    const bool is_number = *end == '\0' && !line.empty();
    if (is_number && value >= least && value <= 1'000'000) return static_cast<std::uint32_t>(value);
    if (!std::cin) return usual;
    mutter(fmt::format("expected a whole number of at least {}\n", least));
  }
}

/// Only at a terminal, and only if nothing was said at all.
bool asks(const InitArguments& arguments) {
  return !arguments.hosts && !arguments.participants && !arguments.endpoints &&
         arguments.ros.empty() && arguments.rmw.empty() && arguments.captures.empty() &&
         !arguments.from_environment && isatty(STDIN_FILENO) != 0 && isatty(STDERR_FILENO) != 0;
}

void ask_all(init::System& system) {
  system.hosts = ask_number("robots and other hosts?", system.hosts, 2);
  system.participants = ask_number(
      "processes with ROS 2 nodes on each (a component container is one)?", system.participants);
  system.endpoints = ask_number("publishers and subscriptions of each?", system.endpoints);
  system.ros = ask("ROS 2 distribution?", system.ros);
  system.rmw = ask("fastrtps or cyclonedds?", system.rmw);
  if (init::looks_up_types(system, model::config::SpecPath::standard())) {
    system.unknown_types = ask_number(
        "message types of a process that others do not have (its own messages, services, "
        "actions)?",
        init::usual_unknown_types, 0);
  }
  system.wireless = ask("network (stormproof list wireless)?", system.wireless);
}

Outcome run(InitArguments& arguments, Session& session) {
  init::System system = arguments.system;
  if (!arguments.ros.empty()) {
    system.ros = arguments.ros;
    system.knows_ros = true;
  }
  if (!arguments.rmw.empty()) system.rmw = arguments.rmw;
  if (arguments.from_environment) {
    auto known = init::from_environment(
        std::move(system),
        [&](const char* name) -> const char* {
          const bool is_given =
              (name == std::string_view{"ROS_DISTRO"} && !arguments.ros.empty()) ||
              (name == std::string_view{"RMW_IMPLEMENTATION"} && !arguments.rmw.empty());
          return is_given ? nullptr : std::getenv(name);
        },
        model::config::SpecPath::standard());
    if (!known) return known.error();
    system = *std::move(known);
  }
  if (asks(arguments)) ask_all(system);
  if (arguments.hosts) system.hosts = static_cast<std::uint32_t>(*arguments.hosts);
  if (arguments.participants)
    system.participants = static_cast<std::uint32_t>(*arguments.participants);
  if (arguments.endpoints) system.endpoints = static_cast<std::uint32_t>(*arguments.endpoints);
  if (arguments.types) system.unknown_types = static_cast<std::uint32_t>(*arguments.types);

  model::config::Result<std::string> text{std::string{}};
  if (arguments.captures.empty()) {
    text = init::draft(system, model::config::SpecPath::standard());
  } else {
    const auto conversation = capture::read_conversation(arguments.captures, session.on_packets());
    if (!conversation) return conversation.error();
    text = init::draft_of_capture(*conversation, system);
  }
  if (!text) return text.error();
  if (!arguments.file.wanted()) {
    print(*text);
    return established;
  }
  arguments.file.stream() << *text;
  say("stormproof: next: " + report::command_line({"simulate", arguments.file.path()}));
  return established;
}

void declare(Options& options, InitArguments& arguments) {
  init::System& system = arguments.system;
  options.captures(arguments.captures, false);
  options.number("--hosts", arguments.hosts, "Robots and other hosts (default 2)", "N")
      .within(1, 1'000);
  options
      .number("--participants", arguments.participants,
              "Processes with nodes on each host (default 4)", "N")
      .within(1, 1'000);
  options
      .number("--endpoints", arguments.endpoints,
              "Publishers and subscriptions of each process (default 20)", "N")
      .within(0, 100'000);
  options
      .number("--unknown-types", arguments.types,
              "Fast DDS 3: message types of a process that others do not have (default 12, as in "
              "Nav2)",
              "N")
      .within(0, 100'000);
  options.text("--ros", arguments.ros, "ROS 2 distribution (default humble)", "NAME");
  options.text("--rmw", arguments.rmw, "fastrtps (default) or cyclonedds", "RMW");
  options.text("--dds", system.dds, "DDS profile, or the vendor's XML file, instead of both",
               "PROFILE");
  options.text("--wireless", system.wireless, "Wireless profile (default wifi-80211n)", "PROFILE");
  options.flag("--from-environment", arguments.from_environment,
               "Take the distribution, RMW, file and way to discover from the environment");
  options.output("-o,--output", arguments.file, "Write the scenario here, not to standard output");
}

}  // namespace

void declare_init(Frame& frame) {
  frame.add<InitArguments>(
      {.name = "init",
       .help = "Draft a scenario of your own system: from numbers, a capture, or questions",
       .exit_codes = "Exit code: 0, or 2 bad input.",
       .formats = Formats::none,
       .takes_long = false},
      declare, run);
}

}  // namespace stormproof::cli
