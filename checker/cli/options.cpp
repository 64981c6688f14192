// The options that several commands have, worded once.
#include "checker/cli/options.hpp"

namespace stormproof::cli {

void add_format(CLI::App& command, bool& json) {
  command
      .add_option_function<std::string>(
          "--format", [&json](const std::string& value) { json = value == "json"; },
          "Output format: text (default) or json")
      ->check(CLI::IsMember({"text", "json"}))
      ->type_name("FORMAT");
}

void add_format(CLI::App& command, report::Format& format) {
  using enum report::Format;
  static const std::map<std::string, report::Format> names{
      {"text", text}, {"json", json},   {"markdown", markdown},
      {"html", html}, {"junit", junit}, {"sarif", sarif}};
  command
      .add_option_function<std::string>(
          "--format", [&format](const std::string& value) { format = names.at(value); },
          "Output format: text (default), json, markdown, html, junit or sarif")
      ->check(CLI::IsMember({"text", "json", "markdown", "html", "junit", "sarif"}))
      ->type_name("FORMAT");
}

CLI::Option* add_repeatable(CLI::App& command, const char* name, std::vector<std::string>& values,
                            const char* help) {
  return command.add_option(name, values, help)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_scenario(CLI::App& command, std::string& scenario, std::vector<std::string>& overrides) {
  command.add_option("scenario", scenario, "Scenario file, or name of a shipped one")
      ->required()
      ->type_name("SCENARIO");
  add_repeatable(command, "--set", overrides,
                 "Override a key of the scenario: key.path=value (repeatable)")
      ->type_name("KEY=VALUE");
}

void add_progress(CLI::App& command, std::optional<bool>& progress) {
  command.add_flag_callback(
      "--progress", [&progress] { progress = true; },
      "Show progress on stderr (default on a terminal)");
  command.add_flag_callback(
      "--no-progress", [&progress] { progress = false; }, "Show no progress");
}

void add_timeout(CLI::App& command, double& seconds) {
  command.add_option("--timeout", seconds, "Seconds for each query, for each solver (default 10)")
      ->check(CLI::Range(0.001, 86'400.0))
      ->type_name("SECONDS");
}

}  // namespace stormproof::cli
