// `stormproof profile show FILE` and `stormproof profile lint FILE…`: what a profile, also in a DDS
// vendor's own XML, really says about discovery.
#include "checker/cli/commands.hpp"
#include "checker/cli/frame.hpp"
#include "checker/presentation/text/command_line.hpp"
#include "checker/verification/profile/lint_report.hpp"
#include "checker/verification/profile/profile_report.hpp"

namespace stormproof::cli {

namespace {

using model::config::SpecPath;

struct ShowArguments {
  std::string reference;
  std::vector<std::string> overrides;  ///< key.path=value, without "dds."
};

Outcome run(ShowArguments& arguments, Session& /*session*/) {
  const SpecPath specs = SpecPath::standard();
  const auto traced = model::config::trace_dds_profile(arguments.reference, arguments.overrides,
                                                       specs, model::config::Outside::admitted);
  if (!traced) return traced.error();
  const report::ProfileReport report = report::describe_profile(*traced, specs);
  Answer answer{document_of(report), to_json(report)};
  answer.document.next = {{report::command_line({"profile", "lint", arguments.reference}),
                           "settings without effect, or that cause storms"}};
  return answer;
}

struct LintArguments {
  std::vector<std::string> references;
};

Outcome run(LintArguments& arguments, Session& /*session*/) {
  const SpecPath specs = SpecPath::standard();
  std::vector<report::LintedFile> files;
  for (const std::string& reference : arguments.references) {
    for (const std::string& part : report::parts_of(reference, specs)) {
      files.push_back(report::lint_profile(part, specs));
    }
  }
  Answer answer{document_of(files), to_json(files)};
  const report::LintCounts counts = count(files);
  const ExitCode readable = counts.errors + counts.warnings > 0 ? violated : established;
  answer.document.exit_code = counts.unreadable > 0 ? bad_input : readable;
  if (counts.unreadable == 0) {
    answer.document.next = {
        {report::command_line({"profile", "show", arguments.references.front()}),
         "every value, where it comes from and whether a user can set it"}};
  }
  return answer;
}

constexpr const char* reference_help =
    "Vendor XML file, with #PROFILE and @PRESET if need be; YAML file, or name of a shipped "
    "profile";

void declare(Options& options, ShowArguments& arguments) {
  options.text("profile", arguments.reference, reference_help, "PROFILE").required();
  options.overrides(arguments.overrides, "the profile");
}

void declare(Options& options, LintArguments& arguments) {
  options.texts("profile", arguments.references, reference_help, "PROFILE...").required();
  options.from_environment();
}

}  // namespace

void declare_profile(Frame& frame) {
  frame.group("profile", "Explain a DDS profile, also in a vendor's own XML: show, lint");
  frame.add<ShowArguments>(
      {.name = "profile show",
       .help = "Every knob of a profile: its value, where that came from, who can change it",
       .exit_codes = "Exit code: 0, or 2 bad input.",
       .formats = Formats::pages,
       .schemas = {report::profile_schema},
       .takes_long = false},
      declare, run);
  frame.add<LintArguments>(
      {.name = "profile lint",
       .help = "What in a profile does not do what it seems to",
       .exit_codes = "Exit code: 0 nothing but notes, 1 warnings or errors, 2 a file cannot be "
                     "read as a profile.",
       .formats = Formats::findings,
       .schemas = {report::lint_schema},
       .takes_long = false},
      declare, run);
}

}  // namespace stormproof::cli
