// A report that is shared says nothing of the machine that made it: files that were found by name
// are shown below "specs", whatever the current folder is.
#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

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
  for (const std::string format : {"text", "markdown", "html", "sarif", "junit"}) {
    if (!judges && (format == "sarif" || format == "junit")) continue;
    const std::string report = output_of(verb + " --format " + format, folder);
    EXPECT_GT(report.size(), 50U) << format;
    for (const std::string path : {std::string{STORMPROOF_SOURCE_DIR}, folder.string()}) {
      const std::size_t at = report.find(path);
      EXPECT_EQ(at, std::string::npos) << format << ": " << report.substr(at, 120);
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
