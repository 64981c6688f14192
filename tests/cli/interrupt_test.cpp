// Ctrl-C on a long run: the program ends by itself with what is known so far, and the files that it
// was writing are complete.
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

namespace interrupt_test {

namespace fs = std::filesystem;

class Interrupt : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "stormproof-interrupt-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Starts a run that would take very long, waits until its trace grows, interrupts it; returns
  /// its exit code.
  int interrupted_run() const {
    const std::string trace = (folder_ / "trace.jsonl").string();
    const std::string partial = trace + ".partial";
    const pid_t child = fork();
    if (child == 0) {
      (void)freopen((folder_ / "out").c_str(), "w", stdout);
      (void)freopen((folder_ / "err").c_str(), "w", stderr);
      execl(STORMPROOF_PROGRAM, "stormproof", "simulate", "high-load-6x30", "--set",
            "deployment.participants_per_host=30", "--set", "time_limit=100000s", "--trace",
            trace.c_str(), "--progress", nullptr);
      _exit(127);
    }
    while (!fs::exists(partial) || fs::file_size(partial) < 100'000) usleep(10'000);
    kill(child, SIGINT);
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  [[nodiscard]] std::string content(const char* name) const {
    std::ifstream in{folder_ / name};
    return {std::istreambuf_iterator<char>{in}, {}};
  }

  fs::path folder_;
};

TEST_F(Interrupt, ReportsWhatIsKnownAndCompletesTheTrace) {
  EXPECT_EQ(interrupted_run(), 3);
  EXPECT_NE(content("out").find("when the run was interrupted"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "trace.jsonl.partial"));
  const std::string trace = content("trace.jsonl");
  ASSERT_FALSE(trace.empty());
  EXPECT_EQ(trace.back(), '\n');
  EXPECT_NE(trace.find("\"end\":\"interrupted\""), std::string::npos);
}

}  // namespace interrupt_test
