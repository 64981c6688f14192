// Every command that README.md, the guide and the findings show can be run as it stands, and where
// a page shows output (a fenced block `console`, the command after "$ "), it is that of the
// program. Commands whose output is not shown are stopped after a second: that they are
// accepted and start is what is tested. A synopsis (with placeholders) is no command.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "tests/cli/shown.hpp"
#include "tests/files.hpp"

namespace pages_test {

namespace fs = std::filesystem;
namespace files = stormproof::files;

struct Command {
  std::string line;                ///< as the page shows it
  std::vector<std::string> shown;  ///< its output
  bool shows_output = false;
};

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return std::string{text.substr(first, text.find_last_not_of(' ') - first + 1)};
}

/// Without the remark behind it.
std::string without_remark(const std::string& line) {
  return trimmed(std::string_view{line}.substr(0, line.find("  #")));
}

bool is_of_the_program(const std::string& line) {
  return line.starts_with("./stormproof ") || line.starts_with("stormproof ");
}

bool is_assignment(const std::string& line) {
  const auto end = line.find('=');
  return end != std::string::npos && end > 0 &&
         std::all_of(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(end),
                     [](unsigned char c) { return std::isupper(c) != 0; });
}

/// SCENARIO, FILE.pcap, [--option], …: to be filled in by the reader.
bool is_synopsis(const std::string& line) {
  static const std::regex placeholder{"…| \\[| [A-Z]{3}"};
  return std::regex_search(line, placeholder);
}

/// Line `at` with the lines that continue it; `at` becomes the last of them.
std::string continued(const std::vector<std::string>& lines, std::size_t& at) {
  std::string line = trimmed(lines[at]);
  while (line.ends_with('\\') && at + 1 < lines.size()) {
    line.pop_back();
    line += trimmed(lines[++at]);
  }
  return line;
}

std::vector<Command> commands_of(const fs::path& page) {
  std::ifstream in{page};
  const std::vector<std::string> lines = shown::lines_of(in);
  std::vector<Command> commands;
  bool fenced = false;
  bool console = false;
  for (std::size_t at = 0; at < lines.size(); ++at) {
    if (lines[at].starts_with("```")) {
      fenced = !fenced;
      console = fenced && lines[at] == "```console";
    } else if (console && lines[at].starts_with("$ ")) {
      commands.push_back({without_remark(lines[at].substr(2)), {}, true});
    } else if (console && !commands.empty()) {
      commands.back().shown.push_back(lines[at]);
    } else if (fenced || lines[at].starts_with("    ")) {
      const std::string line = without_remark(continued(lines, at));
      if (is_assignment(line) || (is_of_the_program(line) && !is_synopsis(line))) {
        commands.push_back({line, {}, false});
      }
    }
  }
  return commands;
}

/// A folder like a clean clone, with the files of his own that a reader would have.
class Reader {
 public:
  Reader() {
    fs::create_directory(home());
    fs::create_directory(folder_ / "output");
    fs::create_directory_symlink(STORMPROOF_SOURCE_DIR "/specs", home() / "specs");
    write("stormproof", "#!/bin/sh\nexec '" STORMPROOF_PROGRAM "' \"$@\"\n", true);
    write("briefly",
          "#!/bin/sh\nexec timeout --foreground -s INT --preserve-status 1 '" STORMPROOF_PROGRAM
          "' \"$@\"\n",
          true);
    const fs::path specs = STORMPROOF_SOURCE_DIR "/specs";
    for (const char* name : {"my-robots.yaml", "fleet.yaml"}) {
      fs::copy_file(specs / "scenarios/smallest.yaml", home() / name);
    }
    fs::copy_file(specs / "grids/small.yaml", home() / "my-grid.yaml");
    for (const char* name : {"robots.xml", "robots-old.xml", "base.xml", "old.xml"}) {
      write(name, named_lidar(specs / "vendor/fastdds/humble-default.xml"), false);
    }
    for (const char* name : {"host0.pcap", "host1.pcap"}) {
      fs::copy_file(specs / "captures/fastdds2611_ap150_np1_ne2_r0.pcap.xz", home() / name);
    }
    for (const char* name : {"candidate.xml", "new.xml", "my.xml"}) {
      fs::copy_file(specs / "vendor/fastdds/large-send-buffer.xml", home() / name);
    }
  }

  /// Assignments hold for the commands after them.
  shown::Output run(const Command& command) {
    if (is_assignment(command.line)) {
      assignments_ += command.line + "; ";
      return {};
    }
    const std::string arguments = command.line.substr(command.line.find(' '));
    const std::string program = command.shows_output ? "./stormproof" : "./briefly";
    return shown::run(assignments_ + program + arguments, home(), folder_ / "output");
  }

 private:
  [[nodiscard]] fs::path home() const { return folder_ / "home"; }
  [[nodiscard]] static std::string named_lidar(const fs::path& file) {
    std::string text = files::content(file);
    const std::string_view name = "\"humble\"";
    text.replace(text.find(name), name.size(), "\"lidar\"");
    return text;
  }
  void write(const char* name, const std::string& text, bool program) const {
    std::ofstream{home() / name} << text;
    if (program) fs::permissions(home() / name, fs::perms::owner_all);
  }

  const files::Folder own_;
  const fs::path folder_ = own_.path();
  std::string assignments_;
};

class Pages : public testing::TestWithParam<fs::path> {};

TEST_P(Pages, ShowsCommandsThatRunAndTheirOutput) {
  Reader reader;
  for (const Command& command : commands_of(GetParam())) {
    const shown::Output actual = reader.run(command);
    const bool accepted = actual.exit_code == 0 || actual.exit_code == 1 || actual.exit_code == 3 ||
                          actual.exit_code == 4;
    EXPECT_TRUE(accepted) << command.line << "\nexit code " << actual.exit_code << "\n"
                          << fmt::format("{}", fmt::join(actual.err, "\n"));
    EXPECT_TRUE(!command.shows_output || shown::matches(command.shown, actual.out))
        << command.line << "\nthe page shows:\n"
        << fmt::format("{}\nthe program says:\n{}", fmt::join(command.shown, "\n"),
                       fmt::join(actual.out, "\n"));
  }
}

std::vector<fs::path> pages() {
  std::vector<fs::path> found{STORMPROOF_SOURCE_DIR "/README.md"};
  for (const char* folder : {"specs/guide", "specs/findings"}) {
    for (const auto& entry : fs::directory_iterator{fs::path{STORMPROOF_SOURCE_DIR} / folder}) {
      if (entry.path().extension() == ".md") found.push_back(entry.path());
    }
  }
  std::sort(found.begin(), found.end());
  std::erase_if(found, [](const fs::path& page) { return commands_of(page).empty(); });
  return found;
}

INSTANTIATE_TEST_SUITE_P(Documents, Pages, testing::ValuesIn(pages()), [](const auto& tested) {
  std::string name = tested.param.stem().string();
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(PagesThemselves, TellCommandsFromSynopses) {
  EXPECT_TRUE(is_synopsis("stormproof conform A.pcap [B.pcap …] [--dds PROFILE]"));
  EXPECT_TRUE(is_synopsis("stormproof simulate SCENARIO --pcap FILE"));
  EXPECT_TRUE(is_synopsis("stormproof doctor CAPTURE…"));
  EXPECT_FALSE(is_synopsis("stormproof draw DescriptorRepair --format svg -o repair.svg"));
  EXPECT_FALSE(is_synopsis("stormproof fuzz my-robots.yaml --loss 2%"));
}

}  // namespace pages_test
