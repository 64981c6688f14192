// The scripts for bash and zsh are a table of words by command, made from the parser, and a
// function that looks up the words of the longest command that the line begins with. Names of
// shipped files are asked of the program when they are needed. fish wants one line for each word.
#include "checker/cli/completion.hpp"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace stormproof::cli {

namespace {

constexpr const char* function = R"bash(
_stormproof() {
  local current="${COMP_WORDS[COMP_CWORD]}" path="stormproof " word
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    [[ -n "${_stormproof_words["$path$word "]+x}" ]] || break
    path+="$word "
  done
  COMPREPLY=($(compgen -W "${_stormproof_words["$path"]}" -- "$current"))
  case "$path$current" in
    *" -"*) return ;;
    *" simulate "* | *" check "* | *" fuzz "* | *" sensitivity "* | *" tune "*) word=scenarios ;;
    *" sweep "*) word=grids ;;
    *" diff "* | *" profile "?*" "*) word=profiles ;;
    *" draw "*) word=machines ;;
    *) word="" ;;
  esac
  [[ -z "$word" ]] || COMPREPLY+=($(compgen -W "$("${COMP_WORDS[0]}" list "$word" --names \
    2>/dev/null)" -- "$current"))
  COMPREPLY+=($(compgen -f -- "$current"))
}
complete -o filenames -F _stormproof stormproof
)bash";

constexpr const char* zsh_function = R"zsh(
local path='stormproof ' word key kind=''
for word in ${words[2,CURRENT-1]}; do
  key="$path$word "
  (( ${+words_of[$key]} )) || break
  path="$key"
done
compadd -- ${=words_of[$path]}
case "$path" in
  'stormproof simulate ' | 'stormproof check ' | 'stormproof fuzz ' | 'stormproof sensitivity ' \
    | 'stormproof tune ') kind=scenarios ;;
  'stormproof sweep ') kind=grids ;;
  'stormproof diff ' | 'stormproof profile '?*) kind=profiles ;;
  'stormproof draw ') kind=machines ;;
esac
[[ -z "$kind" || "${words[CURRENT]}" == -* ]] \
  || compadd -- ${(f)"$(${words[1]} list $kind --names 2>/dev/null)"}
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

/// What fish offers behind `above`, the names of the commands so far.
void add_lines(const CLI::App& command, const std::string& above, std::string& script) {
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
      script += fmt::format("complete -c stormproof -n '{}' -l {}{} -d {}\n", when, name,
                            option->get_expected_max() > 0 ? " -r" : "",
                            described(option->get_description()));
    }
  }
  for (const CLI::App* below : subcommands) {
    add_lines(*below,
              (above.empty() ? "" : above + "; and ") + "__fish_seen_subcommand_from " +
                  below->get_name(),
              script);
  }
}

}  // namespace

std::string bash_completion(const CLI::App& program) {
  std::string script =
      "# Completes stormproof in bash: source <(stormproof completion bash)\n"
      "declare -gA _stormproof_words\n";
  add_words(program, "stormproof ", "_stormproof_words[\"{}\"]=\"{}\"\n", script);
  return script + function;
}

std::string zsh_completion(const CLI::App& program) {
  std::string script =
      "#compdef stormproof\n"
      "# Completes stormproof in zsh: stormproof completion zsh > FOLDER_OF_FPATH/_stormproof\n"
      "local -A words_of=(\n";
  add_words(program, "stormproof ", "  '{}' '{}'\n", script);
  return script + ")" + zsh_function;
}

std::string fish_completion(const CLI::App& program) {
  std::string script = "# Completes stormproof in fish: stormproof completion fish | source\n";
  add_lines(program, "", script);
  return script;
}

}  // namespace stormproof::cli
