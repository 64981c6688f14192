// The way to an up-to-date build that the launcher and the tests take (cmake/bootstrap.sh), with a
// small project in the place of this one: it recovers from what a failed configuration or a library
// that has moved leaves behind, and starts no more compilations than memory is there for.
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/files.hpp"

namespace bootstrap_test {

namespace fs = std::filesystem;

using stormproof::files::content;
using stormproof::files::write;

/// A project without sources in a folder of its own: it needs the file `library`, and with tests
/// also `test_library`.
class Bootstrap : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(home_ / "cmake");
    fs::copy_file(STORMPROOF_SOURCE_DIR "/cmake/bootstrap.sh", home_ / "cmake/bootstrap.sh");
    write(home_ / "cmake/debian-packages.txt", "build sh nothing\ntest sh nothing\n");
    write(
        home_ / "CMakePresets.json",
        R"({"version": 6, "configurePresets": [{"name": "release", "binaryDir": "${sourceDir}/build",
              "cacheVariables": {"STORMPROOF_BUILD_TESTS": "OFF"}}]})");
    write(home_ / "CMakeLists.txt",
          "cmake_minimum_required(VERSION 3.25)\nproject(small LANGUAGES NONE)\n"
          "find_file(LIBRARY NAMES library library-2 PATHS ${CMAKE_SOURCE_DIR} NO_DEFAULT_PATH "
          "REQUIRED)\n"
          "if(STORMPROOF_BUILD_TESTS)\n  find_file(TEST_LIBRARY test_library PATHS "
          "${CMAKE_SOURCE_DIR} NO_DEFAULT_PATH REQUIRED)\nendif()\n"
          "add_custom_command(OUTPUT program COMMAND ${CMAKE_COMMAND} -E copy ${LIBRARY} program "
          "DEPENDS ${LIBRARY})\nadd_custom_target(program_of_it DEPENDS program)\n");
    write(home_ / "library", "first");
  }

  /// Runs a script that has the functions of bootstrap.sh; its exit code.
  int shell(const std::string& script) {
    write(home_ / "script",
          "set -eu\nroot='" + home_.string() + "'\n. \"$root/cmake/bootstrap.sh\"\n" + script);
    return stormproof::files::exit_code_of("sh '" + (home_ / "script").string() + "' > '" +
                                           (home_ / "output").string() + "' 2>&1 </dev/null");
  }
  int build_program() { return shell("bootstrap release build program_of_it build\n"); }
  int build_tests() {
    return shell("bootstrap release build program_of_it 'build test' with_tests\n");
  }
  std::string output() const { return content(home_ / "output"); }

  const stormproof::files::Folder own_;
  const fs::path home_ = own_.path();
};

TEST_F(Bootstrap, BuildsOnceAndIsSilentThen) {
  ASSERT_EQ(build_program(), 0) << output();
  EXPECT_EQ(content(home_ / "build/program"), "first");
  EXPECT_EQ(build_program(), 0);
  EXPECT_EQ(output(), "");
}

TEST_F(Bootstrap, RecoversFromAConfigurationThatFailedInTheSameFolder) {
  ASSERT_EQ(build_program(), 0) << output();
  EXPECT_EQ(build_tests(), 2) << "test_library is missing\n" << output();
  write(home_ / "library", "second");
  EXPECT_EQ(build_program(), 0) << output();
  EXPECT_EQ(content(home_ / "build/program"), "second");
  write(home_ / "test_library", "");
  EXPECT_EQ(build_tests(), 0) << output();
}

TEST_F(Bootstrap, RecoversWhenALibraryHasMoved) {
  ASSERT_EQ(build_program(), 0) << output();
  fs::remove(home_ / "library");
  write(home_ / "library-2", "moved");
  EXPECT_EQ(build_program(), 0) << output();
  EXPECT_EQ(content(home_ / "build/program"), "moved");
}

TEST_F(Bootstrap, SaysThatABuildFailedAndDoesNotTryAgainForNothing) {
  ASSERT_EQ(build_program(), 0) << output();
  fs::remove(home_ / "library");
  EXPECT_EQ(build_program(), 2) << output();
  EXPECT_NE(output().find("cannot configure the build"), std::string::npos) << output();
}

TEST_F(Bootstrap, StartsNoMoreCompilationsThanFitIntoMemory) {
  const auto jobs = [&](const std::string& cores, const std::string& megabytes) {
    EXPECT_EQ(shell("nproc() { echo " + cores + "; }\nfree_megabytes() { echo " + megabytes +
                    "; }\nfitting_jobs\n"),
              0);
    return output();
  };
  EXPECT_EQ(jobs("8", "7000"), "5\n");
  EXPECT_EQ(jobs("8", "32000"), "8\n");
  EXPECT_EQ(jobs("2", "700"), "1\n");
  EXPECT_EQ(jobs("2", ""), "2\n") << "where nobody says how much there is";
  ASSERT_EQ(shell("free_megabytes\n"), 0);
  EXPECT_GT(std::stoll(output()), 0);
}

}  // namespace bootstrap_test
