// Parses the arguments before the work begins.
#include "checker/cli/report_files.hpp"

#include <fmt/core.h>

#include "model/config/tree/suggestion.hpp"

namespace stormproof::cli {

std::optional<model::config::InputError> parse_report_files(
    const std::vector<std::string>& arguments, std::span<const NamedFormat> offered,
    std::deque<ReportFile>& files) {
  std::vector<std::string> names;
  std::string list;
  for (const auto& [name, format] : offered) {
    names.push_back(name);
    list += (list.empty() ? "" : ", ") + name;
  }
  for (const std::string& argument : arguments) {
    const std::size_t equals = argument.find('=');
    const std::string word = argument.substr(0, equals);
    bool is_format = false;
    bool taken = false;
    for (const auto& [name, format] : offered) {
      if (word != name) continue;
      is_format = true;
      taken = equals < argument.size() - 1;
      if (taken) files.emplace_back(format, argument.substr(equals + 1));
    }
    if (taken) continue;
    return model::config::InputError{
        "--report " + argument,
        fmt::format("expected FORMAT=FILE, FORMAT one of {}{}", list,
                    is_format ? "" : model::config::suggestion(word, names))};
  }
  return std::nullopt;
}

}  // namespace stormproof::cli
