// How commands declare what they accept. The parser itself (CLI11) stays in options.cpp, frame.cpp
// and given.cpp: its header costs seconds in every source file that includes it.
#pragma once

#include <concepts>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace stormproof::cli {

class OutputFile;

/// What the frame has to know about the options of a command, beside their values.
struct Declared {
  struct File {
    OutputFile* file;
    const CLI::Option* option;
    std::string path;  ///< empty: not asked for
  };
  struct Place {
    const CLI::Option* option;
    const std::string* path;
    bool is_folder;  ///< and nothing else
  };
  std::deque<File> files;
  std::vector<Place> places;  ///< that the command itself writes to
  std::vector<const CLI::Option*> not_repeated;
};

/// One option, for what most do not need.
class Option {
 public:
  Option(CLI::Option& option, Declared& declared) : option_{&option}, declared_{&declared} {}

  Option required() const;
  Option excludes(const Option& other) const;
  Option needs(const Option& other) const;
  /// Numbers from `least` to `most`; whole ones, if the limits are.
  template <class Number>
  Option within(Number least, Number most) const {
    if constexpr (std::integral<Number>) {
      return within_whole(static_cast<std::int64_t>(least), static_cast<std::int64_t>(most));
    } else {
      return within_real(least, most);
    }
  }
  /// The value may be left out, and is `text` then.
  Option or_alone(const std::string& text) const;
  Option one_of(const std::vector<std::string>& words) const;
  /// It says how or where the answer is shown, so the line "repeat it with" leaves it out.
  Option not_repeated() const;

 private:
  Option within_whole(std::int64_t least, std::int64_t most) const;
  Option within_real(double least, double most) const;

  CLI::Option* option_;
  Declared* declared_;
};

/// The options of one command, in the order in which its help and "repeat it with" have them.
/// A name that does not start with "-" is that of a positional. `type` names the value in the help.
/// What an option is bound to has to outlive the parsing.
class Options {
 public:
  Options(CLI::App& command, Declared& declared) : command_{command}, declared_{declared} {}

  Option text(const char* name, std::string& value, const std::string& help, const char* type);
  /// May be given several times, each time with one value. As a positional: one word or more.
  Option texts(const char* name, std::vector<std::string>& values, const std::string& help,
               const char* type);
  /// For std::size_t, std::uint32_t, double, and std::optional of the first and last.
  template <class Number>
  Option number(const char* name, Number& value, const std::string& help, const char* type);
  /// --from-environment, for whatever reads vendors' files; `overrides` has it.
  void from_environment();
  Option flag(const char* name, bool& value, const std::string& help);
  Option flag(const char* name, std::function<void()> given, const std::string& help);
  /// One of some words, each of which stands for a value.
  template <class T>
  Option choice(const char* name, T& value, std::vector<std::pair<std::string, T>> words,
                const std::string& help, const char* type) {
    std::vector<std::string> names;
    for (const auto& [word, meaning] : words) names.push_back(word);
    return choice(
        name, std::move(names),
        [&value, words = std::move(words)](const std::string& chosen) {
          for (const auto& [word, meaning] : words) {
            if (word == chosen) value = meaning;
          }
        },
        help, type);
  }
  Option choice(const char* name, std::vector<std::string> words,
                std::function<void(const std::string&)> chosen, const std::string& help,
                const char* type);

  /// A file that the command writes beside its report. The frame opens it before the work begins,
  /// and gives it its name when the work is done.
  Option output(const char* name, OutputFile& file, const std::string& help);
  /// A folder that the command writes into. The frame refuses a path that can be none.
  Option folder(const char* name, std::string& path, const std::string& help,
                const char* type = "DIR");
  /// What the command writes to in its own way: a database, or a folder or a file. The frame sees
  /// to it that it is none of the files that are read or written otherwise.
  Option written(const char* name, std::string& path, const std::string& help, const char* type);

  // ---- what several commands have: the same names and words everywhere --------------------------
  /// The scenario, and `--set`.
  void scenario(std::string& scenario, std::vector<std::string>& overrides);
  /// `--set`: "a key of WHOSE".
  Option overrides(std::vector<std::string>& overrides, const char* whose);
  /// pcap files of one run.
  Option captures(std::vector<std::string>& files, bool required = true);
  /// `--until`, for `parse_until`.
  Option until(std::string& instant, const std::string& help);
  Option svg(OutputFile& file, const std::string& help);
  Option jobs(std::size_t& threads);
  Option seed(std::uint64_t& seed, const std::string& help);
  Option start_jitter(std::string& duration);
  /// `--timeout` of a solver's queries.
  Option timeout(double& seconds);

 private:
  Option made(CLI::Option* option) { return {*option, declared_}; }

  CLI::App& command_;
  Declared& declared_;
};

}  // namespace stormproof::cli
