// What `tune -o DIR` writes deploys what it recommends: settings, and with a launch plan the files
// that start each process when the plan says so.
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/files.hpp"

namespace tune_files_test {

namespace fs = std::filesystem;
namespace files = stormproof::files;

TEST(TuneFiles, StartProcessesByTheRecommendedPlan) {
  const files::Folder own;
  const std::string said = files::output_of(
      "cd '" + own.path().string() +
      "' && " STORMPROOF_PROGRAM " tune fleet-4x2x20 --budget 50 --samples 6 -o tuned 2>&1");
  std::smatch step;
  ASSERT_TRUE(
      std::regex_search(said, step, std::regex{"Start processes process by process, ([0-9.]+)ms"}))
      << said;
  const double apart = std::stod(step[1]) / 1e3;
  ASSERT_TRUE(fs::exists(own.path() / "tuned/recommended.xml"));
  std::vector<double> starts;
  for (int host = 0; host < 4; ++host) {
    const fs::path launch = own.path() / ("tuned/host-" + std::to_string(host) + ".launch.py");
    const std::string text = files::content(launch);
    const std::regex period{"period=([0-9.]+)"};
    for (std::sregex_iterator at{text.begin(), text.end(), period}, end; at != end; ++at) {
      starts.push_back(std::stod((*at)[1]));
    }
    EXPECT_TRUE(
        fs::exists(own.path() / ("tuned/host-" + std::to_string(host) + "-process_1.service")));
  }
  ASSERT_EQ(starts.size(), 8U);
  for (std::size_t k = 1; k < starts.size(); ++k) {
    EXPECT_NEAR(starts[k] - starts[k - 1], apart, 1.1e-3);  // written to the millisecond
  }
}

}  // namespace tune_files_test
