// The scripts for bash and zsh are tables made from the parser, words by command and kinds of names
// by command and option, and a function that looks up the longest command that the line begins
// with. Names of shipped files are asked of the program when they are needed. fish wants one line
// for each word.
#include "checker/cli/completion.hpp"

#include <string>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace stormproof::cli {

namespace {

/// What `stormproof list KIND --names` offers behind a command or an option.
struct Names {
  std::string_view behind;
  std::string_view kind;
};
constexpr Names all_names[] = {
    {"simulate", "scenarios"},    {"check", "scenarios"},       {"fuzz", "scenarios"},
    {"sensitivity", "scenarios"}, {"tune", "scenarios"},        {"sweep", "grids"},
    {"diff", "profiles"},         {"profile show", "profiles"}, {"profile lint", "profiles"},
    {"draw", "machines"},         {"--dds", "profiles"},        {"--compare", "profiles"},
    {"--preset", "profiles"},     {"--wireless", "wireless"},   {"--over", "scenarios"},
    {"--policy", "policies"},     {"--property", "properties"}, {"--mutant", "mutants"},
    {"--exhibit", "exhibits"},    {"museum", "exhibits"}};

/// Empty: none.
std::string_view names_behind(std::string_view command_or_option) {
  for (const Names& one : all_names) {
    if (one.behind == command_or_option) return one.kind;
  }
  return {};
}

/// An entry of the table of a shell, as `line` has it, for each command and option.
void add_names(const char* line, std::string& script) {
  for (const Names& one : all_names) {
    const bool is_option = one.behind.starts_with('-');
    const std::string key =
        is_option ? std::string{one.behind} : fmt::format("stormproof {} ", one.behind);
    script += fmt::format(fmt::runtime(line), key, one.kind);
  }
}

constexpr const char* bash_function = R"bash(
_stormproof() {
  local current="${COMP_WORDS[COMP_CWORD]}" at="stormproof " word kind
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    [[ -n "${_stormproof_words["$at$word "]+x}" ]] || break
    at+="$word "
  done
  kind="${_stormproof_names["${COMP_WORDS[COMP_CWORD-1]}"]-}"
  COMPREPLY=()
  if [[ -z "$kind" ]]; then
    COMPREPLY=($(compgen -W "${_stormproof_words["$at"]}" -- "$current"))
    [[ "$current" != -* ]] || return
    kind="${_stormproof_names["$at"]-}"
  fi
  [[ -z "$kind" ]] || COMPREPLY+=($(compgen -W "$("${COMP_WORDS[0]}" list "$kind" --names \
    2>/dev/null)" -- "$current"))
  COMPREPLY+=($(compgen -f -- "$current"))
}
complete -o filenames -F _stormproof stormproof
)bash";

constexpr const char* zsh_function = R"zsh(
local at='stormproof ' word key kind="${names_of[${words[CURRENT-1]}]}"
if [[ -z "$kind" ]]; then
  for word in ${words[2,CURRENT-1]}; do
    key="$at$word "
    (( ${+words_of[$key]} )) || break
    at="$key"
  done
  compadd -- ${=words_of[$at]}
  [[ "${words[CURRENT]}" == -* ]] || kind="${names_of[$at]}"
fi
[[ -z "$kind" ]] || compadd -- ${(f)"$(${words[1]} list $kind --names 2>/dev/null)"}
_files
)zsh";

/// One line for `command`, whose path is "profile show ", and for those below it; `line` has places
/// for the path and its words.
void add_words(const CLI::App& command, const std::string& path, const char* line,
               std::string& script) {
  std::string words;
  for (const CLI::App* below : command.get_subcommands({})) words += below->get_name() + " ";
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) words += "--" + name + " ";
  }
  script += fmt::format(fmt::runtime(line), path, words);
  for (const CLI::App* below : command.get_subcommands({})) {
    add_words(*below, path + below->get_name() + " ", line, script);
  }
}

/// The first sentence, quoted for fish.
std::string described(const std::string& help) {
  std::string text = "'";
  for (const char c : help.substr(0, help.find('\n'))) {
    if (c == '\'' || c == '\\') text += '\\';
    text += c;
  }
  return text + "'";
}

std::string names_for_fish(std::string_view kind) {
  return kind.empty() ? "" : fmt::format(" -a '(stormproof list {} --names 2>/dev/null)'", kind);
}

/// What fish offers for the command `path` when the condition `above` holds: its names have been
/// typed.
void add_lines(const CLI::App& command, const std::string& path, const std::string& above,
               std::string& script) {
  const auto subcommands = command.get_subcommands({});
  std::string names;
  for (const CLI::App* below : subcommands) names += " " + below->get_name();
  std::string when = above.empty() ? "__fish_use_subcommand" : above;
  if (!above.empty() && !names.empty()) {
    when += "; and not __fish_seen_subcommand_from" + names;
  }
  for (const CLI::App* below : subcommands) {
    script += fmt::format("complete -c stormproof -f -n '{}' -a {} -d {}\n", when,
                          below->get_name(), described(below->get_description()));
  }
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      script += fmt::format("complete -c stormproof -n '{}' -l {}{}{} -d {}\n", when, name,
                            option->get_expected_max() > 0 ? " -r" : "",
                            names_for_fish(names_behind("--" + name)),
                            described(option->get_description()));
    }
  }
  if (const std::string_view kind = names_behind(path); !kind.empty()) {
    script += fmt::format("complete -c stormproof -n '{}'{}\n", when, names_for_fish(kind));
  }
  for (const CLI::App* below : subcommands) {
    add_lines(*below, path.empty() ? below->get_name() : path + " " + below->get_name(),
              (above.empty() ? "" : above + "; and ") + "__fish_seen_subcommand_from " +
                  below->get_name(),
              script);
  }
}

}  // namespace

std::string bash_completion(const CLI::App& program) {
  std::string script =
      "# Completes stormproof in bash: source <(stormproof completion bash)\n"
      "declare -gA _stormproof_words _stormproof_names\n";
  add_words(program, "stormproof ", "_stormproof_words[\"{}\"]=\"{}\"\n", script);
  add_names("_stormproof_names[\"{}\"]={}\n", script);
  return script + bash_function;
}

std::string zsh_completion(const CLI::App& program) {
  std::string script =
      "#compdef stormproof\n"
      "# Completes stormproof in zsh: stormproof completion zsh > FOLDER_OF_FPATH/_stormproof\n"
      "local -A words_of=(\n";
  add_words(program, "stormproof ", "  '{}' '{}'\n", script);
  script += ")\nlocal -A names_of=(\n";
  add_names("  '{}' '{}'\n", script);
  return script + ")" + zsh_function;
}

std::string fish_completion(const CLI::App& program) {
  std::string script = "# Completes stormproof in fish: stormproof completion fish | source\n";
  add_lines(program, "", "", script);
  return script;
}

}  // namespace stormproof::cli
