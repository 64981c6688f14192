// Runs SPIN on models in tests, which are skipped where it is not installed.
#pragma once

#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "checker/engines/promela/run_spin.hpp"

namespace stormproof::promela {

class SpinTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!spin_is_available()) GTEST_SKIP() << "spin or gcc is not installed";
    folder_ =
        std::filesystem::temp_directory_path() / ("stormproof-promela-" + std::to_string(getpid()));
    std::filesystem::create_directory(folder_);
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }

  SpinRun verify(const std::string& model) {
    const auto run = run_spin(model, folder_.string());
    EXPECT_TRUE(run) << run.error();
    return run ? *run : SpinRun{};
  }
  void expect_correct(const std::string& model, std::uint64_t least_states) {
    const SpinRun run = verify(model);
    EXPECT_TRUE(run.ok) << run.error;
    EXPECT_EQ(run.error, "");
    EXPECT_GE(run.states, least_states);
    EXPECT_GT(run.seconds, 0);
  }
  void expect_error(const std::string& model, const std::string& expected) {
    const SpinRun run = verify(model);
    EXPECT_FALSE(run.ok);
    EXPECT_EQ(run.error.substr(0, expected.size()), expected);
    EXPECT_GT(run.states, 0U);
  }
  std::filesystem::path folder_;
};

}  // namespace stormproof::promela
