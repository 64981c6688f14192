// Reads CLI11's results back.
#include "checker/cli/given.hpp"

#include <algorithm>

#include <CLI/CLI.hpp>

#include "checker/presentation/text/command_line.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::cli {

std::vector<Given> given_to(const CLI::App& command,
                            const std::vector<const CLI::Option*>& left_out) {
  Given names{"", {}};
  for (const CLI::App* app = &command; app != nullptr; app = app->get_parent()) {
    const bool is_root = app->get_parent() == nullptr;
    names.values.insert(names.values.begin(), is_root ? report::program() : app->get_name());
  }
  std::vector<Given> given{names};
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0 || std::ranges::find(left_out, option) != left_out.end()) continue;
    const bool is_flag = option->get_items_expected_max() == 0;
    given.push_back({option->get_positional() ? std::string{} : option->get_name(),
                     is_flag ? std::vector<std::string>{} : option->results()});
  }
  return given;
}

std::string shell_line(const std::vector<Given>& given,
                       std::initializer_list<std::string_view> without) {
  std::string line;
  const auto add = [&line](const std::string& word) {
    line += (line.empty() ? "" : " ") + report::shell_word(word);
  };
  const auto looks_like_option = [](const std::string& word) { return word.starts_with('-'); };
  std::vector<std::string> after_dashes;  // positionals that the parser would take for options
  for (const auto& [option, values] : given) {
    if (std::ranges::find(without, option) != without.end()) continue;
    if (option.empty()) {
      const bool plain = std::ranges::none_of(values, looks_like_option);
      for (const std::string& word : values) plain ? add(word) : after_dashes.push_back(word);
      continue;
    }
    if (values.empty()) add(option);
    for (const std::string& value : values) {
      if (looks_like_option(value)) {
        add(option + "=" + value);
      } else {
        add(option);
        add(value);
      }
    }
  }
  if (!after_dashes.empty()) add("--");
  for (const std::string& word : after_dashes) add(word);
  return line;
}

}  // namespace stormproof::cli
