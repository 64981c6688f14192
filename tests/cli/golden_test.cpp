// Runs every command of tests/cli/golden/*.txt in the project's root and compares standard output,
// standard error and exit code with what the file says. The files are documentation too: each shows
// what a user sees.
//
//   # comment
//   $ stormproof simulate smallest      the command
//   …                                   its standard output
//   ! …                                 its standard error
//   exit 0                              its exit code; the next command may follow
//
// A line of output that is only "..." stands for any number of lines. To accept changed output
// after reading it: STORMPROOF_UPDATE_GOLDEN=1 (files with "..." are left alone).
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/cli/shown.hpp"
#include "tests/files.hpp"

namespace golden_test {

namespace fs = std::filesystem;

struct Step {
  std::vector<std::string> comments;
  std::string command;
  std::vector<std::string> out;
  std::vector<std::string> err;
  int exit_code = 0;
};

std::vector<Step> read_steps(const fs::path& file) {
  std::ifstream in{file};
  std::vector<Step> steps;
  std::vector<std::string> comments;
  for (const std::string& line : shown::lines_of(in)) {
    if (line.starts_with("$ ")) {
      steps.push_back({comments, line.substr(2), {}, {}, -1});
      comments.clear();
    } else if (line.starts_with("exit ") && !steps.empty() && steps.back().exit_code < 0) {
      steps.back().exit_code = std::stoi(line.substr(5));
    } else if (steps.empty() || steps.back().exit_code >= 0) {
      comments.push_back(line);
    } else if (line.starts_with("! ")) {
      steps.back().err.push_back(line.substr(2));
    } else {
      steps.back().out.push_back(line);
    }
  }
  return steps;
}

Step run(const Step& expected, const fs::path& folder) {
  const shown::Output actual = shown::run(expected.command, STORMPROOF_SOURCE_DIR, folder);
  return {expected.comments, expected.command, actual.out, actual.err, actual.exit_code};
}

std::string text_of(const Step& step) {
  std::ostringstream text;
  for (const auto& line : step.comments) text << line << '\n';
  text << "$ " << step.command << '\n';
  for (const auto& line : step.out) text << line << '\n';
  for (const auto& line : step.err) text << "! " << line << '\n';
  text << "exit " << step.exit_code << '\n';
  return text.str();
}

class Golden : public testing::TestWithParam<fs::path> {};

TEST_P(Golden, OutputAndExitCode) {
  const std::vector<Step> steps = read_steps(GetParam());
  ASSERT_FALSE(steps.empty());
  const stormproof::files::Folder folder{"stormproof-golden"};
  std::string updated;
  bool elided = false;
  for (const Step& step : steps) {
    ASSERT_GE(step.exit_code, 0) << "no `exit` line after: " << step.command;
    const Step actual = run(step, folder.path());
    EXPECT_TRUE(shown::matches(step.out, actual.out) && shown::matches(step.err, actual.err) &&
                step.exit_code == actual.exit_code)
        << "expected:\n"
        << text_of(step) << "\ngot:\n"
        << text_of(actual);
    updated += text_of(actual);
    for (const auto& line : step.out) elided = elided || line == "...";
  }
  if (std::getenv("STORMPROOF_UPDATE_GOLDEN") != nullptr && !elided) {
    std::ofstream{GetParam()} << updated;
  }
}

std::vector<fs::path> golden_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator{STORMPROOF_SOURCE_DIR "/tests/cli/golden"}) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

INSTANTIATE_TEST_SUITE_P(Files, Golden, testing::ValuesIn(golden_files()), [](const auto& tested) {
  std::string name = tested.param.stem().string();
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace golden_test
