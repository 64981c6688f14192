// The help: every command has it, with examples that run as they stand; the same by `help COMMAND`;
// what it lists is there; and bash completes what the parser knows.
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/files.hpp"

namespace help_test {

namespace fs = std::filesystem;
namespace files = stormproof::files;

/// A folder with the shipped files in it, in which lines of a shell run.
class Shell {
 public:
  Shell() { fs::create_directory_symlink(STORMPROOF_SPECS_DIR, folder_.path() / "specs"); }

  /// Standard output; the exit code is in `code`, standard error in `errors`.
  std::string operator()(const std::string& line) {
    const fs::path& folder = folder_.path();
    files::write(
        folder / "typed.sh",
        "PATH='" + fs::path{STORMPROOF_PROGRAM}.parent_path().string() + "':$PATH\n" + line + '\n');
    code =
        files::exit_code_of("cd '" + folder.string() + "' && bash typed.sh >out 2>err </dev/null");
    errors = files::content(folder / "err");
    return files::content(folder / "out");
  }

  int code = -1;
  std::string errors;

 private:
  files::Folder folder_;
};

/// "simulate", …, "profile show": what the front page of the help lists.
std::vector<std::string> commands() {
  const auto below = [](const std::string& path) {
    Shell shell;
    std::istringstream help{shell("stormproof " + path + "--help")};
    std::vector<std::string> names;
    bool listed = false;
    for (std::string line; std::getline(help, line);) {
      if (line == "Subcommands:") {
        listed = true;
      } else if (listed && line.starts_with("  ") && line[2] != ' ') {
        names.push_back(path + line.substr(2, line.find(' ', 2) - 2));
      }
    }
    return names;
  };
  std::vector<std::string> all;
  for (const std::string& name : below("")) {
    const std::vector<std::string> inner = below(name + " ");
    all.insert(all.end(), inner.begin(), inner.end());
    if (inner.empty()) all.push_back(name);
  }
  return all;
}

/// Lines of a shell in what the program prints.
std::vector<std::string> lines_to_type(const std::string& text) {
  std::istringstream in{text};
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("  stormproof ")) lines.push_back(line.substr(2));
  }
  return lines;
}

void expect_examples_that_run(const std::string& command) {
  SCOPED_TRACE(command);
  Shell shell;
  const std::string help = shell("stormproof " + command + " --help");
  EXPECT_EQ(shell.code, 0);
  EXPECT_EQ(shell("stormproof help " + command), help);
  std::istringstream in{help};
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("  stormproof ")) continue;
    EXPECT_LE(line.size(), 100U) << line;
  }
  const std::vector<std::string> lines = lines_to_type(help);
  EXPECT_GE(lines.size(), 1U) << help;
  EXPECT_LE(lines.size(), 3U) << help;
  for (const std::string& line : lines) {
    const std::string out = shell(line);
    if (shell.errors.find("setcap") != std::string::npos) continue;  // nobody may capture here
    // A violation, a run that does not complete and a capture that does not conform are answers.
    EXPECT_TRUE(shell.code == 0 || shell.code == 1 || shell.code == 3 || shell.code == 4)
        << line << ": " << shell.code << '\n'
        << shell.errors;
    const bool to_a_file =
        line.find(" -o ") != std::string::npos || line.find('>') != std::string::npos;
    EXPECT_TRUE(to_a_file || !out.empty()) << line;
  }
}

/// One test, not one for each: who lists the tests of this program would ask for the help of every
/// command each time.
TEST(Commands, HaveExamplesThatRun) {
  const std::vector<std::string> all = commands();
  EXPECT_GE(all.size(), 17U);
  for (const std::string& command : all) expect_examples_that_run(command);
}

TEST(FrontPage, ItsCommandsRun) {
  Shell shell;
  const std::vector<std::string> lines = lines_to_type(shell("stormproof"));
  EXPECT_EQ(shell.code, 0);
  ASSERT_EQ(lines.size(), 7U);
  for (const std::string& line : lines) {
    const std::string command = line.substr(0, line.find(' ', std::string{"stormproof "}.size()));
    if (shell(command + " --help").find("  " + line + "\n") != std::string::npos) continue;
    EXPECT_FALSE(shell(line).empty()) << line;
    EXPECT_TRUE(shell.code == 0 || shell.code == 1) << line << '\n' << shell.errors;
  }
}

TEST(List, HoldsWhatTheCommandsTake) {
  Shell shell;
  const auto json = nlohmann::json::parse(shell("stormproof list --format json"));
  ASSERT_EQ(json.at("lists").size(), 13U);
  for (const auto& list : json.at("lists")) {
    EXPECT_FALSE(list.at("entries").empty()) << list.at("kind");
    for (const auto& entry : list.at("entries")) {
      EXPECT_FALSE(entry.at("name").get<std::string>().empty());
      const auto what = entry.at("what").get<std::string>();
      EXPECT_GT(what.size(), 5U) << entry;
      EXPECT_EQ(what.find('\n'), std::string::npos) << entry;
      EXPECT_EQ(what.find("cannot be read"), std::string::npos) << entry;
    }
  }
  EXPECT_NE(shell("stormproof list profiles --names").find("\nhumble\n"), std::string::npos);
  for (const std::string kind : {"scenarios", "findings"}) {
    std::istringstream names{shell("stormproof list " + kind + " --names")};
    for (std::string name; std::getline(names, name);) {
      if (name.ends_with(".md")) continue;  // a page to read
      shell("stormproof simulate '" + name + "' --set time_limit=2s");
      EXPECT_NE(shell.code, 2) << name << shell.errors;
    }
  }
}

/// What bash offers for a line, whose last word is the one that is completed.
std::string completed(const std::string& line) {
  Shell shell;
  return shell("source <(stormproof completion bash)\nCOMP_WORDS=(" + line +
               ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_stormproof\n"
               "printf '%s\\n' \"${COMPREPLY[@]}\"");
}

TEST(Completion, KnowsCommandsOptionsAndNames) {
  EXPECT_EQ(completed("stormproof simu"), "simulate\n");
  EXPECT_EQ(completed("stormproof profile li"), "lint\n");
  EXPECT_EQ(completed("stormproof profile show --se"), "--set\n");
  EXPECT_EQ(completed("stormproof simulate --sam"), "--samples\n");
  EXPECT_EQ(completed("stormproof diff --exhibit E8"), "E8a\nE8b\n");
  EXPECT_EQ(completed("stormproof fuzz smallest --start"), "--start-jitter\n");
  EXPECT_EQ(completed("stormproof simulate three"), "three-hosts\n");
  EXPECT_EQ(completed("stormproof diff humb"), "humble\n");
  EXPECT_EQ(completed("stormproof conform spe"), "specs\n");
  EXPECT_EQ(completed("stormproof check smallest --property live.compl"), "live.completion\n");
  EXPECT_EQ(completed("stormproof simulate smallest --wireless wir"), "wired\n");
}

/// The candidates of zsh, which has to be told what the functions of its completion system do.
std::string of_zsh(const std::string& line) {
  Shell shell;
  return shell("zsh -fc 'compadd() { shift; print -l -- \"$@\" }; _files() { : }; words=(" + line +
               "); CURRENT=${#words}; source <(stormproof completion zsh)' | sort -u");
}

std::string of_fish(const std::string& line) {
  Shell shell;
  return shell("fish -c 'stormproof completion fish | source; complete -C \"" + line +
               "\"' | cut -f 1");
}

bool has_line(const std::string& text, const std::string& line) {
  return ("\n" + text).find("\n" + line + "\n") != std::string::npos;
}

TEST(Completion, OfZshOffersWordsAndNames) {
  EXPECT_TRUE(has_line(of_zsh("stormproof si"), "simulate"));
  EXPECT_TRUE(has_line(of_zsh("stormproof profile li"), "lint"));
  EXPECT_TRUE(has_line(of_zsh("stormproof simulate thr"), "three-hosts"));
  EXPECT_TRUE(has_line(of_zsh("stormproof simulate --sam"), "--samples"));
  EXPECT_FALSE(has_line(of_zsh("stormproof simulate --sam"), "three-hosts"));
  EXPECT_TRUE(has_line(of_zsh("stormproof check smallest --property live"), "live.completion"));
}

TEST(Completion, OfFishOffersWordsAndNames) {
  EXPECT_TRUE(has_line(of_fish("stormproof si"), "simulate"));
  EXPECT_TRUE(has_line(of_fish("stormproof profile li"), "lint"));
  EXPECT_TRUE(has_line(of_fish("stormproof simulate thr"), "three-hosts"));
  EXPECT_TRUE(has_line(of_fish("stormproof simulate --sam"), "--samples"));
  EXPECT_TRUE(has_line(of_fish("stormproof check smallest --property live.c"), "live.completion"));
  EXPECT_TRUE(has_line(of_fish("stormproof profile show hum"), "humble"));
}

TEST(Manual, HasEveryCommandAndNoStrayRequest) {
  Shell shell;
  const std::string page = shell("stormproof man");
  for (std::string command : commands()) {
    for (std::size_t at = 0; (at = command.find('-', at)) != std::string::npos; at += 2) {
      command.insert(at, "\\");  // as roff has a hyphen that is one
    }
    EXPECT_NE(page.find("\n.SS stormproof " + command + "\n"), std::string::npos) << command;
  }
  std::istringstream lines{page};
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with('.')) continue;
    const std::string request = line.substr(1, 2);
    EXPECT_TRUE(request == "TH" || request == "SH" || request == "SS" || request == "TP" ||
                request == "B " || request == "I " || request == "nf" || request == "fi")
        << line;
  }
}

}  // namespace help_test
