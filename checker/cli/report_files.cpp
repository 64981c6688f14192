// Parses the arguments before the work begins, and writes the files after it.
#include "checker/cli/report_files.hpp"

#include <array>

#include <fmt/format.h>

#include "checker/cli/counterexample_files.hpp"
#include "checker/cli/options.hpp"
#include "model/config/tree/suggestion.hpp"

namespace stormproof::cli {

namespace {

using model::config::Result;
using report::Format;

constexpr std::array<std::pair<const char*, Format>, 6> formats{{{"text", Format::text},
                                                                 {"json", Format::json},
                                                                 {"markdown", Format::markdown},
                                                                 {"html", Format::html},
                                                                 {"junit", Format::junit},
                                                                 {"sarif", Format::sarif}}};

Result<ReportFile> parse(const std::string& argument) {
  const std::size_t equals = argument.find('=');
  const std::string name = argument.substr(0, equals);
  std::vector<std::string> others;
  for (const auto& [word, format] : formats) {
    if (name != word) {
      others.emplace_back(word);
    } else if (equals < argument.size() - 1) {
      return ReportFile{format, argument.substr(equals + 1)};
    }
  }
  const bool has_format = others.size() < formats.size();
  return model::config::InputError{
      "--report " + argument,
      fmt::format("expected FORMAT=FILE, FORMAT one of text, json, markdown, html, junit, sarif{}",
                  has_format ? "" : model::config::suggestion(name, others))};
}

}  // namespace

void add_report_files(CLI::App& command, std::vector<std::string>& arguments) {
  add_repeatable(command, "--report", arguments,
                 "Write the report in another format, too: html=FILE (repeatable)")
      ->type_name("FORMAT=FILE");
}

Result<std::vector<ReportFile>> parse_report_files(const std::vector<std::string>& arguments) {
  std::vector<ReportFile> files;
  for (const std::string& argument : arguments) {
    const auto file = parse(argument);
    if (!file) return file.error();
    files.push_back(*file);
  }
  return files;
}

std::optional<std::string> write_report_files(
    const std::vector<ReportFile>& files,
    const std::function<std::string(report::Format)>& render) {
  for (const ReportFile& file : files) {
    if (auto error = write_text(file.path, render(file.format))) return error;
  }
  return std::nullopt;
}

}  // namespace stormproof::cli
