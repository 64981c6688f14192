// A report that is shared says nothing of the machine that made it: files that were found by name
// are shown below "specs", whatever the current folder is.
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace shared_reports_test {

namespace fs = std::filesystem;

std::string output_of(const std::string& arguments, const fs::path& folder) {
  const std::string command =
      "cd '" + folder.string() + "' && " STORMPROOF_PROGRAM " " + arguments + " 2>/dev/null";
  std::string text;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return text;
  std::array<char, 4096> buffer{};
  for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    text.append(buffer.data(), n);
  }
  pclose(pipe);
  return text;
}

class SharedReports : public testing::TestWithParam<const char*> {};

TEST_P(SharedReports, HoldNoPathOfTheMachine) {
  std::string pattern = (fs::temp_directory_path() / "stormproof-shared-XXXXXX").string();
  ASSERT_NE(mkdtemp(pattern.data()), nullptr);
  const fs::path folder{pattern};
  const std::string verb = GetParam();
  const bool judges = !verb.starts_with("profile") && !verb.starts_with("sensitivity");
  std::string command = verb + " --report markdown=markdown --report html=html";
  if (judges) command += " --report sarif=sarif --report junit=junit";
  std::vector<std::pair<std::string, std::string>> reports{{"text", output_of(command, folder)}};
  for (const auto& entry : fs::directory_iterator{folder}) {
    if (!entry.is_regular_file()) continue;
    std::stringstream text;
    text << std::ifstream{entry.path()}.rdbuf();
    reports.emplace_back(entry.path().filename().string(), text.str());
  }
  EXPECT_GE(reports.size(), judges ? 5U : 3U);
  for (const auto& [name, report] : reports) {
    EXPECT_GT(report.size(), 50U) << name;
    for (const std::string& path : {std::string{STORMPROOF_SOURCE_DIR}, folder.string()}) {
      const std::size_t at = report.find(path);
      EXPECT_EQ(at, std::string::npos)
          << name << ": " << report.substr(std::min(at, report.size()), 120);
    }
  }
  fs::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(Verbs, SharedReports,
                         testing::Values("check smallest --property live.completion",
                                         "simulate smallest", "fuzz smallest --runs 2",
                                         "diff fastdds-2.6.11 cyclonedds-0.10 --over smallest",
                                         "profile show fastdds-2.6.11",
                                         "profile lint fastdds-2.6.11",
                                         "sensitivity smallest --samples 1"));

}  // namespace shared_reports_test
