// The script is a table of words by command, made from the parser, and a function that looks up the
// words of the longest command that the line begins with. Names of shipped files are asked of the
// program when they are needed.
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

/// One line for `command`, whose path is "profile show ", and for those below it.
void add_words(const CLI::App& command, const std::string& path, std::string& script) {
  std::string words;
  for (const CLI::App* below : command.get_subcommands({})) words += below->get_name() + " ";
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) words += "--" + name + " ";
  }
  script += fmt::format("_stormproof_words[\"{}\"]=\"{}\"\n", path, words);
  for (const CLI::App* below : command.get_subcommands({})) {
    add_words(*below, path + below->get_name() + " ", script);
  }
}

}  // namespace

std::string bash_completion(const CLI::App& program) {
  std::string script =
      "# Completes stormproof in bash: source <(stormproof completion bash)\n"
      "declare -gA _stormproof_words\n";
  add_words(program, "stormproof ", script);
  return script + function;
}

}  // namespace stormproof::cli
