// The life of a command: its files are opened, it runs, its answer is completed and shown.
#include "checker/cli/frame.hpp"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "checker/cli/complain.hpp"
#include "checker/cli/completion.hpp"
#include "checker/cli/durations.hpp"
#include "checker/cli/examples.hpp"
#include "checker/cli/memory_limit.hpp"
#include "checker/cli/narrow_help.hpp"
#include "checker/cli/overwriting.hpp"
#include "checker/cli/parse_error.hpp"
#include "checker/cli/report_files.hpp"
#include "checker/cli/streams.hpp"
#include "checker/cli/terminal.hpp"
#include "checker/engines/smt/claims.hpp"
#include "checker/presentation/json/describe.hpp"
#include "checker/presentation/json/dumped.hpp"
#include "checker/presentation/json/head.hpp"
#include "checker/presentation/text/paragraph.hpp"
#include "model/config/spec_path.hpp"

namespace stormproof::cli {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using report::Format;

std::vector<NamedFormat> formats_of(Formats formats) {
  std::vector<NamedFormat> all{{"text", Format::text},
                               {"json", Format::json},
                               {"markdown", Format::markdown},
                               {"html", Format::html}};
  if (formats == Formats::tables) all.emplace_back("csv", Format::csv);
  if (formats == Formats::review) all.emplace_back("github", Format::github);
  if (formats == Formats::findings || formats == Formats::review) {
    all.insert(all.end(), {{"junit", Format::junit}, {"sarif", Format::sarif}});
  }
  return all;
}

/// The document and the JSON with what all of them have. The keys are those of
/// specs/guide/output.md.
void complete(Answer& answer, const std::string& command) {
  report::Document& document = answer.document;
  if (document.command.empty()) document.command = command;
  if (!answer.listing.empty()) {
    report::Bullets files;
    for (const std::string& line : answer.listing) files.items.emplace_back(line);
    document.blocks.emplace_back(report::Section{"Files", "files", {std::move(files)}});
  }
  answer.json =
      with_head(std::move(answer.json), document.command, document.exit_code, !document.complete);
}

std::string render(const Answer& answer, const Verb& verb, Format format,
                   const report::Terminal& terminal) {
  if (format == Format::json) return report::dumped(answer.json);
  switch (format) {
    case Format::json:
      break;
    case Format::csv:
      return answer.csv;
    case Format::markdown:
      return to_markdown(answer.document);
    case Format::github:
      return to_comment(answer.document, verb.name);
    case Format::html:
      return to_html(answer.document);
    case Format::junit:
      return to_junit(answer.document);
    case Format::sarif:
      return report::dumped(to_sarif(answer.document));
    case Format::text:
      return to_text(answer.document, terminal);
  }
  return {};
}

/// Why nothing can be written into `folder`, as far as that is known before there is something.
std::optional<std::string> refuse_folder(const std::string& option, const std::string& folder) {
  std::error_code ignored;
  const auto status = fs::status(folder, ignored);
  if (folder.empty() || fs::is_directory(status) || !fs::exists(status)) return std::nullopt;
  return fmt::format("{} {}: is no folder", option, folder);
}

/// `--time`, in seconds; nothing if it was not given.
model::config::Result<std::optional<double>, std::string> seconds_of(const std::string& time) {
  if (time.empty()) return std::optional<double>{};
  constexpr model::Nanoseconds longest{1'000'000'000'000'000};
  const auto duration = parse_positive_duration("--time", time, longest);
  if (!duration) return duration.error();
  return std::optional{static_cast<double>(duration->count()) * 1e-9};
}

/// Why an answer is not complete, if the work was stopped.
void say_why_not(const std::string& time) {
  if (InterruptGuard::short_of_memory()) {
    complain(needs_more_memory());
  } else if (InterruptGuard::out_of_time()) {
    say("stormproof: --time " + time + " is over; this is what was known by then");
  } else if (InterruptGuard::interrupted()) {
    say("stormproof: interrupted; this is what was known by then");
  }
}

}  // namespace

ordered_json with_head(ordered_json content, const std::string& command, int exit_code,
                       bool interrupted) {
  ordered_json json = report::json_of(report::Head{command, exit_code, interrupted});
  for (auto& [key, value] : content.items()) json.emplace(key, std::move(value));
  return json;
}

namespace {

/// As specs/schema/output has it; whatever else was given is not looked at.
[[noreturn]] void show_schema(const Verb& verb) {
  const std::string title = "What stormproof " + verb.name + " --format json prints";
  print(report::dumped(report::schema_of(title, verb.schemas)));
  throw CLI::Success{};
}

}  // namespace

/// A verb, with what its options were set to.
struct Frame::Command {
  Verb verb;
  const CLI::App* parsed = nullptr;
  std::function<Outcome(Session&)> run;
  Process process = Process::own;
  Declared declared{};
  Format format = Format::text;
  std::vector<std::string> report_arguments{};
  std::deque<ReportFile> reports{};
  bool verbose = false;
  std::optional<bool> progress{};  ///< not given: when stderr is a terminal
  std::string max_memory{};        ///< as written; empty: what the machine has
  std::string time{};              ///< as written; empty: as long as it takes

  void declare_own(Options& options);
  int execute();

 private:
  using Errors = std::vector<std::string>;

  [[nodiscard]] std::optional<std::string> refuse_overwriting() const;
  std::optional<std::string> open_files();
  void write_files(const Answer& answer, Errors& errors);
  void commit_declared(Errors& errors);
  int show(Answer& answer, const std::vector<Given>& given);
};

void Frame::Command::declare_own(Options& options) {
  const std::vector<NamedFormat> offered = formats_of(verb.formats);
  std::string names;
  for (std::size_t k = 0; k < offered.size(); ++k) {
    names += (k == 0 ? "" : k + 1 < offered.size() ? ", " : " or ") + offered[k].first;
    if (k == 0) names += " (default)";
  }
  options.choice("--format", format, offered, "Output format: " + names, "FORMAT").not_repeated();
  options
      .texts("--report", report_arguments,
             "Write the answer in another format, too: html=FILE (repeatable)", "FORMAT=FILE")
      .not_repeated();
  options.flag("-v,--verbose,--explain", verbose, "Show the details in the text, too")
      .not_repeated();
  if (!verb.takes_long) return;
  options
      .flag(
          "--progress", [this] { progress = true; },
          "Show progress on stderr (default on a terminal)")
      .not_repeated();
  options
      .flag(
          "--no-progress", [this] { progress = false; }, "Show no progress")
      .not_repeated();
  options.text("--time", time,
               "Stop after this much time by the clock, and say what is known: 60s, 5min", "TIME");
  options
      .text("--max-memory", max_memory,
            "Stop before more memory than this is used: 500MB, 4GiB (default: three quarters of "
            "the machine's)",
            "SIZE")
      .not_repeated();
}

/// Before any file is made.
std::optional<std::string> Frame::Command::refuse_overwriting() const {
  std::vector<Target> targets;
  std::vector<const CLI::Option*> written = declared.not_repeated;
  const auto add = [&](const CLI::Option* option, const std::string& path) {
    written.push_back(option);
    if (!path.empty()) targets.push_back({option->get_name(), path});
  };
  for (const Declared::Place& place : declared.places) add(place.option, *place.path);
  for (const Declared::File& file : declared.files) add(file.option, file.path);
  for (const ReportFile& report : reports) targets.push_back({"--report", report.path});
  return overwriting(targets, given_to(*parsed, written));
}

std::optional<std::string> Frame::Command::open_files() {
  if (verb.formats != Formats::none) {
    if (const auto error = parse_report_files(report_arguments, formats_of(verb.formats), reports))
      return to_string(*error);
  }
  if (!verb.writes()) return std::nullopt;
  if (auto error = refuse_overwriting()) return error;
  for (const auto& [option, path, is_folder] : declared.places) {
    if (!is_folder || path->empty()) continue;
    if (auto error = refuse_folder(option->get_name(), *path)) return error;
  }
  for (auto& [file, option, path] : declared.files) {
    file->open(path, option->get_name() + " " + path);
    if (auto error = file->open_error()) return error;
  }
  for (ReportFile& report : reports) {
    report.file.open(report.path, "--report " + report.path);
    if (auto error = report.file.open_error()) return error;
  }
  return std::nullopt;
}

/// Each file for itself: one that cannot be written keeps no other from it.
void Frame::Command::write_files(const Answer& answer, Errors& errors) {
  const report::Terminal terminal{.verbose = verbose};
  const auto commit = [&](OutputFile& file, Format in) {
    auto error = file.open_error();
    if (!error) file.stream() << render(answer, verb, in, terminal);
    if (!error) error = file.commit();
    if (error) errors.push_back(*error);
  };
  for (ReportFile& report : reports) commit(report.file, report.format);
  for (const auto& [path, in] : answer.files) {
    OutputFile file{path};
    commit(file, in);
  }
  commit_declared(errors);
}

/// The files that the command itself has written to.
void Frame::Command::commit_declared(Errors& errors) {
  for (auto& [file, option, path] : declared.files) {
    if (auto error = file->commit()) errors.push_back(*error);
  }
}

/// Prints the answer and writes its files; the exit code, which says if something of it was lost.
int Frame::Command::show(Answer& answer, const std::vector<Given>& given) {
  complete(answer, shell_line(given));
  report::Terminal terminal = standard_output();
  terminal.verbose = verbose;
  Errors errors;
  write_files(answer, errors);
  if (!answer.complaint.empty()) errors.insert(errors.begin(), answer.complaint);
  if (!errors.empty()) {
    answer.document.exit_code = bad_input;
    answer.json["exit_code"] = bad_input;
  }
  print(render(answer, verb, format, terminal));
  for (const std::string& note : answer.notes) say(visible(note));
  if (!answer.document.complete) say_why_not(time);
  for (const std::string& error : errors) complain(error);
  return answer.document.exit_code;
}

int Frame::Command::execute() {
  const auto limit = memory_limit(max_memory);
  if (!limit) return complain(limit.error());
  process == Process::own ? limit_memory(*limit) : watch_memory(*limit);
  const auto seconds = seconds_of(time);
  if (!seconds) return complain(seconds.error());
  const InterruptGuard guard{*seconds, process};
  if (const auto error = open_files()) return complain(*error);
  const std::vector<Given> given = given_to(*parsed, declared.not_repeated);
  Outcome outcome = [&] {
    const bool at_terminal = process == Process::own && isatty(STDERR_FILENO) != 0;
    Session session{given, progress.value_or(at_terminal)};
    return run(session);
  }();
  if (const auto* complaint = std::get_if<Complaint>(&outcome)) return complain(complaint->message);
  if (const auto* code = std::get_if<ExitCode>(&outcome)) {
    say_why_not(time);
    Errors errors;
    commit_declared(errors);
    for (const std::string& error : errors) complain(error);
    return errors.empty() ? *code : bad_input;
  }
  return show(std::get<Answer>(outcome), given);
}

namespace {

class NarrowFormatter : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    const std::size_t columns = std::min(report::report_width, standard_output().columns);
    return narrow_help(CLI::Formatter::make_help(app, std::move(name), mode), columns);
  }
};

}  // namespace

struct Frame::Parser {
  Process process = Process::own;
  CLI::App app{"stormproof: will these ROS 2 / DDS participants discover each other in time?"};
  std::deque<Command> commands;
  Command* chosen = nullptr;
};

/// The program, what decides its proofs, what its JSON looks like, and the libraries it knows.
static std::string version_text() {
  return fmt::format(
      "stormproof {}\n{}, JSON schema {}\nprofiles: {}", STORMPROOF_VERSION,
      smt::Claims::solver_name(), report::json_version,
      fmt::join(model::config::SpecPath::standard().names(model::config::SpecKind::dds), ", "));
}

Frame::Frame(Process process) : parser_{std::make_unique<Parser>()} {
  parser_->process = process;
  parser_->app.name("stormproof");
  parser_->app.formatter(std::make_shared<NarrowFormatter>());
  parser_->app.set_version_flag("--version", version_text);
  parser_->app.require_subcommand(1);
}

Frame::~Frame() = default;

void Frame::group(const char* name, const char* help) {
  parser_->app.add_subcommand(name, help)->require_subcommand(1);
}

void Frame::add(Verb verb, const std::function<void(Options&)>& declare,
                std::function<Outcome(Session&)> work) {
  CLI::App* parent = &parser_->app;
  std::string name = verb.name;
  if (const std::size_t space = name.find(' '); space != std::string::npos) {
    parent = parent->get_subcommand(name.substr(0, space));
    name = name.substr(space + 1);
  }
  CLI::App* app = parent->add_subcommand(name, verb.help);
  const std::string examples = examples_text(verb.name);
  app->footer(verb.exit_codes +
              "\nAlso 2 if something could not be written, 3 if it was stopped: "
              "Ctrl-C, --time, --max-memory." +
              (examples.empty() ? "" : "\n\n" + examples));
  parser_->commands.push_back(Command{std::move(verb), app, std::move(work), parser_->process});
  Command& command = parser_->commands.back();
  Options options{*app, command.declared};
  declare(options);
  if (command.verb.formats != Formats::none) command.declare_own(options);
  if (!command.verb.schemas.empty()) {
    app->add_flag_callback("--json-schema", [&command] { show_schema(command.verb); })->group("");
  }
  app->callback([this, &command] { parser_->chosen = &command; });
}

int Frame::run(int argc, char** argv) { return run({argv + std::min(argc, 1), argv + argc}); }

int Frame::run(std::vector<std::string> words) {
  CLI::App& app = parser_->app;
  if (words.empty()) {
    print(front_page());
    return established;
  }
  if (const auto complaint = refuse(words)) return complain(complaint->message);
  std::ranges::reverse(words);  // as the parser takes them
  try {
    app.parse(words);
  } catch (const CLI::Success& asked) {  // for help or the version
    std::ostringstream said;
    const int code = app.exit(asked, said, said);
    print(said.str());
    return code == 0 ? established : bad_input;
  } catch (const CLI::ParseError& error) {
    return complain(said_of(app, error));
  }
  return parser_->chosen->execute();
}

std::optional<Complaint> Frame::refuse(const std::vector<std::string>& words) const {
  const std::string why = no_command(parser_->app, words);
  return why.empty() ? std::nullopt : std::optional{Complaint{why}};
}

std::string Frame::help_of(const std::vector<std::string>& words) const {
  const CLI::App* app = &parser_->app;
  std::string path = app->get_name();
  for (const std::string& word : words) {
    if (app->get_subcommands({}).empty()) break;
    app = app->get_subcommand(word);
    path += " " + word;
  }
  return app->get_formatter()->make_help(app, path, CLI::AppFormatMode::Normal);
}

std::string Frame::completion(std::string_view shell) const {
  if (shell == "zsh") return zsh_completion(parser_->app);
  if (shell == "fish") return fish_completion(parser_->app);
  return bash_completion(parser_->app);
}

std::string Frame::man_page() const { return cli::man_page(parser_->app); }

}  // namespace stormproof::cli
