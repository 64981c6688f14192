// A report that is shared says nothing of the machine that made it: files that were found by name
// are shown below "specs", whatever the current folder is.
#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/files.hpp"

namespace shared_reports_test {

namespace fs = std::filesystem;
namespace files = stormproof::files;

class SharedReports : public testing::TestWithParam<const char*> {};

TEST_P(SharedReports, HoldNoPathOfTheMachine) {
  const files::Folder own;
  const fs::path& folder = own.path();
  const std::string verb = GetParam();
  const bool judges = !verb.starts_with("profile") && !verb.starts_with("sensitivity");
  std::string command = "cd '" + folder.string() + "' && " STORMPROOF_PROGRAM " " + verb +
                        " --report markdown=markdown --report html=html";
  if (judges) command += " --report sarif=sarif --report junit=junit";
  std::vector<std::pair<std::string, std::string>> reports{
      {"text", files::output_of(command + " 2>/dev/null")}};
  for (const auto& entry : fs::directory_iterator{folder}) {
    if (!entry.is_regular_file()) continue;
    reports.emplace_back(entry.path().filename().string(), files::content(entry.path()));
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
}

INSTANTIATE_TEST_SUITE_P(Verbs, SharedReports,
                         testing::Values("check smallest --property live.completion",
                                         "simulate smallest", "fuzz smallest --runs 2",
                                         "diff fastdds-2.6.11 cyclonedds-0.10 --over smallest",
                                         "profile show fastdds-2.6.11",
                                         "profile lint fastdds-2.6.11",
                                         "sensitivity smallest --samples 1"));

}  // namespace shared_reports_test
