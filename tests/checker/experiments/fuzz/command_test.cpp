// The command itself: time limits, interruption, exit codes and commands that repeat a result.
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/files.hpp"

namespace command_test {

namespace fs = std::filesystem;
namespace files = stormproof::files;

class FuzzCommand : public testing::Test {
 protected:
  /// Exit code of `stormproof fuzz ARGUMENTS`, whose output goes to the file `out`.
  [[nodiscard]] int fuzz(const std::string& arguments, const std::string& out) const {
    const std::string command = "cd '" + folder_.string() + "' && PATH='" +
                                fs::path{STORMPROOF_PROGRAM}.parent_path().string() +
                                "':$PATH stormproof fuzz " + arguments + " >" + out + " 2>err";
    return files::exit_code_of(command);
  }
  [[nodiscard]] std::string content(const std::string& name) const {
    return files::content(folder_ / name);
  }

  const files::Folder own_;
  const fs::path folder_ = own_.path();
};

TEST_F(FuzzCommand, is_the_same_on_one_thread_and_on_two) {
  const std::string arguments = "smallest --runs 30 --loss 20% --limit completion=50ms --jobs ";
  EXPECT_EQ(fuzz(arguments + "1", "one"), 1);
  EXPECT_EQ(fuzz(arguments + "2", "two"), 1);
  EXPECT_FALSE(content("one").empty());
  EXPECT_EQ(content("one"), content("two"));
  EXPECT_TRUE(fs::exists(folder_ / "stormproof-out" / "fuzz-smallest" / "limit.completion.yaml"));
  EXPECT_TRUE(fs::exists(folder_ / "stormproof-out" / "fuzz-smallest" / "limit.completion.svg"));
}

TEST_F(FuzzCommand, its_commands_repeat_its_result) {
  EXPECT_EQ(fuzz("smallest --runs 15 --loss 20% --vary dds.sedp.heartbeat_period=1s..2s --limit "
                 "completion=50ms --seed 4 --format json",
                 "first"),
            1);
  const auto report = nlohmann::json::parse(content("first"));
  const std::string program = "stormproof fuzz ";
  std::string command = report["command"];
  ASSERT_TRUE(command.starts_with(program)) << command;
  EXPECT_EQ(fuzz(command.substr(program.size()) + " --format json", "again"), 1);
  EXPECT_EQ(content("again"), content("first"));
  const auto& limit = report["verdicts"][0];
  ASSERT_EQ(limit["id"], "limit.completion");
  command = limit["first_command"];
  EXPECT_EQ(fuzz(command.substr(program.size()) + " --format json", "single"), 1);
  const auto single = nlohmann::json::parse(content("single"));
  EXPECT_EQ(single["verdicts"][0]["violating_runs"][0], limit["violating_runs"][0]);
}

TEST_F(FuzzCommand, ends_after_the_time_that_it_was_given) {
  EXPECT_EQ(fuzz("smallest --seconds 0.2 --property safety.snapshot --format json", "out"), 0);
  const auto report = nlohmann::json::parse(content("out"));
  const std::size_t runs = report["runs"];
  EXPECT_GT(runs, 0U);
  const std::string command = report["command"];
  EXPECT_NE(command.find(" --runs " + std::to_string(runs) + " "), std::string::npos) << command;
}

TEST_F(FuzzCommand, reports_what_is_known_when_it_is_interrupted) {
  const pid_t child = fork();
  if (child == 0) {
    (void)freopen((folder_ / "out").c_str(), "w", stdout);
    (void)freopen((folder_ / "err").c_str(), "w", stderr);
    execl(STORMPROOF_PROGRAM, "stormproof", "fuzz", "smallest", "--property", "safety.snapshot",
          "--runs", "1000000", "--progress", nullptr);
    _exit(127);
  }
  while (!fs::exists(folder_ / "err") || fs::file_size(folder_ / "err") < 10) usleep(10'000);
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_NE(content("out").find("Interrupted after "), std::string::npos) << content("out");
  EXPECT_NE(content("out").find("safety.snapshot"), std::string::npos);
  EXPECT_NE(content("err").find(" of 1000000 runs, "), std::string::npos);
}

}  // namespace command_test
