// Options in CLI11's terms, and the ones that several commands have, worded once.
#include "checker/cli/options.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <limits>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "checker/cli/output_file.hpp"
#include "model/config/tree/suggestion.hpp"
#include "model/config/vendor/variables.hpp"

namespace stormproof::cli {

namespace {

constexpr const char* any_whole_number = "any whole number";

/// The parser alone would take "-1" for 2⁶⁴ − 1.
CLI::Validator whole_number(std::uint64_t least, std::uint64_t most) {
  return CLI::Validator{
      [=](const std::string& text) {
        std::uint64_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool is_whole = !text.empty() && end == text.data() + text.size();
        const bool fits = error == std::errc{} && value >= least && value <= most;
        if (is_whole && fits) return std::string{};
        const bool is_negative = text.size() > 1 && text.front() == '-';
        return fmt::format("'{}' is {}; expected a whole number from {} to {}", text,
                           is_negative ? "negative"
                           : is_whole  ? "out of range"
                                       : "not a whole number",
                           least, most);
      },
      least == 0 ? std::string{} : fmt::format("{} to {}", least, most)};
}

CLI::Validator one_word_of(std::vector<std::string> words) {
  std::string shown = fmt::format("{{{}}}", fmt::join(words, ","));
  return CLI::Validator{[words = std::move(words)](const std::string& text) {
                          if (std::ranges::find(words, text) != words.end()) return std::string{};
                          return fmt::format("'{}' is not known{}; expected one of {}", text,
                                             model::config::suggestion(text, words),
                                             fmt::join(words, ", "));
                        },
                        std::move(shown)};
}

}  // namespace

Option Option::required() const {
  option_->required();
  return *this;
}

Option Option::excludes(const Option& other) const {
  option_->excludes(other.option_);
  return *this;
}

Option Option::needs(const Option& other) const {
  option_->needs(other.option_);
  return *this;
}

Option Option::within_whole(std::int64_t least, std::int64_t most) const {
  option_->get_validator(any_whole_number)->active(false);  // what it may be is said better here
  option_->check(whole_number(static_cast<std::uint64_t>(least), static_cast<std::uint64_t>(most)));
  return *this;
}

Option Option::within_real(double least, double most) const {
  option_->check(CLI::Validator{[=](const std::string& text) {
                                  char* end = nullptr;
                                  const double value = std::strtod(text.c_str(), &end);
                                  const bool is_number = !text.empty() && *end == '\0';
                                  if (is_number && value >= least && value <= most)
                                    return std::string{};
                                  return fmt::format(
                                      "'{}' is {}; expected a number from {} to {}", text,
                                      is_number ? "out of range" : "not a number", least, most);
                                },
                                fmt::format("{} to {}", least, most)});
  return *this;
}

Option Option::or_alone(const std::string& text) const {
  option_->expected(0, 1)->default_str(text);
  return *this;
}

Option Option::one_of(const std::vector<std::string>& words) const {
  option_->check(one_word_of(words));
  return *this;
}

Option Option::not_repeated() const {
  declared_->not_repeated.push_back(option_);
  return *this;
}

Option Options::text(const char* name, std::string& value, const std::string& help,
                     const char* type) {
  return made(command_.add_option(name, value, help)->type_name(type));
}

Option Options::texts(const char* name, std::vector<std::string>& values, const std::string& help,
                      const char* type) {
  CLI::Option* option = command_.add_option(name, values, help)->type_name(type);
  if (*name == '-') {
    option->allow_extra_args(false)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  }
  return made(option);
}

template <class Number>
Option Options::number(const char* name, Number& value, const std::string& help, const char* type) {
  CLI::Option* option = command_.add_option(name, value, help)->type_name(type);
  if constexpr (std::is_same_v<Number, std::uint32_t>) {
    option->check(
        whole_number(0, std::numeric_limits<std::uint32_t>::max()).name(any_whole_number));
  } else if constexpr (!std::is_same_v<Number, double> &&
                       !std::is_same_v<Number, std::optional<double>>) {
    option->check(
        whole_number(0, std::numeric_limits<std::uint64_t>::max()).name(any_whole_number));
  }
  return made(option);
}
template Option Options::number(const char*, std::uint32_t&, const std::string&, const char*);
template Option Options::number(const char*, std::uint64_t&, const std::string&, const char*);
template Option Options::number(const char*, double&, const std::string&, const char*);
template Option Options::number(const char*, std::optional<std::uint64_t>&, const std::string&,
                                const char*);
template Option Options::number(const char*, std::optional<double>&, const std::string&,
                                const char*);

Option Options::flag(const char* name, bool& value, const std::string& help) {
  return made(command_.add_flag(name, value, help));
}

Option Options::flag(const char* name, std::function<void()> given, const std::string& help) {
  return made(command_.add_flag_callback(name, std::move(given), help));
}

Option Options::choice(const char* name, std::vector<std::string> words,
                       std::function<void(const std::string&)> chosen, const std::string& help,
                       const char* type) {
  return made(command_.add_option_function<std::string>(name, std::move(chosen), help)
                  ->check(one_word_of(words))
                  ->type_name(type));
}

Option Options::output(const char* name, OutputFile& file, const std::string& help) {
  declared_.files.push_back({&file, nullptr, {}});
  Declared::File& declared = declared_.files.back();
  CLI::Option* option = command_.add_option(name, declared.path, help)->type_name("FILE");
  declared.option = option;
  return made(option).not_repeated();
}

Option Options::folder(const char* name, std::string& path, const std::string& help,
                       const char* type) {
  CLI::Option* option = command_.add_option(name, path, help)->type_name(type);
  declared_.places.push_back({option, &path, true});
  return made(option).not_repeated();
}

Option Options::written(const char* name, std::string& path, const std::string& help,
                        const char* type) {
  CLI::Option* option = command_.add_option(name, path, help)->type_name(type);
  declared_.places.push_back({option, &path, false});
  return made(option);
}

void Options::scenario(std::string& scenario, std::vector<std::string>& changes) {
  text("scenario", scenario, "Scenario file, name of a shipped one, or - for standard input",
       "SCENARIO")
      .required();
  overrides(changes, "the scenario");
}

Option Options::overrides(std::vector<std::string>& overrides, const char* whose) {
  from_environment();
  return texts("--set", overrides,
               "Override a key of " + std::string{whose} + ": key.path=value (repeatable)",
               "KEY=VALUE");
}

void Options::from_environment() {
  flag("--from-environment", model::config::vendor::take_variables_from_environment,
       "Take ${VARIABLE} in Cyclone DDS files from the environment (default: what the file says)");
}

Option Options::captures(std::vector<std::string>& files, bool required) {
  const Option option =
      texts("captures", files,
            "pcap or pcapng, plain, .xz or .gz, - from standard input; several of one run are "
            "merged",
            "FILE");
  return required ? option.required() : option;
}

Option Options::until(std::string& instant, const std::string& help) {
  return text("--until", instant, help + ": a duration after the first packet, or ns since 1970",
              "INSTANT");
}

Option Options::svg(OutputFile& file, const std::string& help) {
  return output("--svg", file, help);
}

Option Options::jobs(std::size_t& threads) {
  return number("--jobs", threads, "Runs at the same time (default: all cores)", "N")
      .within(1, 4'096)
      .not_repeated();  // any number of threads gives the same answer
}

Option Options::seed(std::uint64_t& seed, const std::string& help) {
  return number("--seed", seed, help, "S");
}

Option Options::start_jitter(std::string& duration) {
  return text("--start-jitter", duration, "Each participant starts up to this much later",
              "DURATION");
}

Option Options::timeout(double& seconds) {
  return number("--timeout", seconds,
                "Interrupt a solver after so many seconds at one query (default 120)", "SECONDS")
      .within(0.001, 86'400.0);
}

}  // namespace stormproof::cli
