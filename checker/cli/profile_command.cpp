// Reads profiles with their places and prints what the reports make of them.
#include "checker/cli/profile_command.hpp"

#include <memory>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "checker/cli/exit_code.hpp"
#include "checker/cli/options.hpp"
#include "checker/presentation/document/render.hpp"
#include "checker/presentation/json/dumped.hpp"
#include "checker/verification/profile/lint_report.hpp"
#include "checker/verification/profile/profile_report.hpp"

namespace stormproof::cli {

namespace {

using model::config::SpecPath;

struct ShowArguments {
  std::string reference;
  std::vector<std::string> overrides;  ///< key.path=value, without "dds."
  bool json = false;
};

int show(const ShowArguments& arguments) {
  const SpecPath specs = SpecPath::standard();
  const auto traced = model::config::trace_dds_profile(arguments.reference, arguments.overrides,
                                                       specs, model::config::Outside::admitted);
  if (!traced) {
    fmt::print(stderr, "stormproof: {}\n", to_string(traced.error()));
    return bad_input;
  }
  const report::ProfileReport profile = report::describe_profile(*traced, specs);
  fmt::print("{}",
             arguments.json ? report::dumped(to_json(profile)) : to_text(document_of(profile)));
  return established;
}

struct LintArguments {
  std::vector<std::string> references;
  bool json = false;
};

int lint(const LintArguments& arguments) {
  const SpecPath specs = SpecPath::standard();
  std::vector<report::LintedFile> files;
  for (const std::string& reference : arguments.references) {
    files.push_back(report::lint_profile(reference, specs));
  }
  fmt::print("{}", arguments.json ? report::dumped(to_json(files)) : to_text(document_of(files)));
  const report::LintCounts counts = count(files);
  if (counts.unreadable > 0) return bad_input;
  return counts.errors + counts.warnings > 0 ? violated : established;
}

constexpr const char* reference_help =
    "Vendor XML file, with #PROFILE and @PRESET if need be; YAML file, or name of a shipped "
    "profile";

void declare_show(CLI::App& parent, Command& chosen) {
  const auto arguments = std::make_shared<ShowArguments>();
  CLI::App* command = parent.add_subcommand(
      "show", "Every knob of a profile: its value, where that came from, who can change it");
  command->add_option("profile", arguments->reference, reference_help)
      ->required()
      ->type_name("PROFILE");
  add_repeatable(*command, "--set", arguments->overrides,
                 "Override a key of the profile: key.path=value (repeatable)")
      ->type_name("KEY=VALUE");
  add_format(*command, arguments->json);
  command->footer("Exit code: 0, or 2 bad input.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return show(*arguments); }; });
}

void declare_lint(CLI::App& parent, Command& chosen) {
  const auto arguments = std::make_shared<LintArguments>();
  CLI::App* command =
      parent.add_subcommand("lint", "What in a profile does not do what it seems to");
  command->add_option("profile", arguments->references, reference_help)
      ->required()
      ->type_name("PROFILE...");
  add_format(*command, arguments->json);
  command->footer(
      "Exit code: 0 nothing but notes, 1 warnings or errors, 2 a file cannot be read as a "
      "profile.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return lint(*arguments); }; });
}

}  // namespace

void declare_profile(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand(
      "profile", "Explain a DDS profile, also in a vendor's own XML: show, lint");
  command->require_subcommand(1);
  declare_show(*command, chosen);
  declare_lint(*command, chosen);
}

}  // namespace stormproof::cli
